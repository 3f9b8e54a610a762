// Where the project's files are: beside the program's sources, or where SLAGFLOW_SOURCE says.
#pragma once

#include <cstdlib>
#include <string>

namespace slagflow::testing_tools {

inline std::string source_file(const std::string& name) {
  const char* moved = std::getenv("SLAGFLOW_SOURCE");
  return std::string(moved ? moved : SLAGFLOW_SOURCE_DIR) + "/" + name;
}

}  // namespace slagflow::testing_tools
