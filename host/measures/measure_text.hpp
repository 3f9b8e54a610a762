// Words of the measures.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace slagflow {

inline std::string format(const char* pattern, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

// "+x" of anything with an axis and a sign.
template <class T>
std::string direction_name(const T& direction) {
  return std::string(direction.sign > 0 ? "+" : "-") + "xyz"[direction.axis];
}

}  // namespace slagflow
