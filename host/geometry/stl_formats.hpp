// Files that are no STL, by what they begin with.
#pragma once

#include <string>

namespace slagflow {

// "a PLY file", or empty where nothing is known of such a beginning.
std::string other_format(const std::string& bytes);

}  // namespace slagflow
