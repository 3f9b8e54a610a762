// What is said of the keys of a case file to people and their editors. All of it comes from their
// declarations.
#pragma once

#include <string>

namespace slagflow {

// `slagflow help [TOPIC]`: a key, a table, or without a topic all tables. Throws InputError when there is
// neither.
std::string key_help(const std::string& topic);

// The reference of keys as Markdown: that of host/README.md.
std::string key_page();

// A JSON schema (draft 7) of a case file.
std::string key_schema();

}  // namespace slagflow
