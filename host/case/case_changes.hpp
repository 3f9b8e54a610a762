// In what two cases differ, key by key.
#pragma once

#include <string>
#include <vector>

#include "host/case/case.hpp"

namespace slagflow {

// A key as --set takes it, and its values as TOML; empty: it is not there.
struct KeyChange {
  std::string key, before, after;
};

// Of cases with every key, as they are resolved; in the order of keys.
std::vector<KeyChange> key_changes(const Case& before, const Case& after);

// "fluid.slag.yield_stress 5.0 -> 8.0"
std::string text_of(const KeyChange&);

// "fluid.slag.yield_stress=8.0", for --set in a shell.
std::string as_assignment(const KeyChange&);

// A word of a command line for the shell, in quotes where it needs them.
std::string shell_word(const std::string&);

}  // namespace slagflow
