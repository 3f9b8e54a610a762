// What to change in a case that is too coarse, too slow or too large.
#pragma once

#include <string>
#include <vector>

namespace slagflow {

struct BuiltCase;
struct CaseCheck;

// A line each, as "key = value: what comes of it". None where nothing needs a change.
std::vector<std::string> advice(const CaseCheck& check, const BuiltCase& built);

}  // namespace slagflow
