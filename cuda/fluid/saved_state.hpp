// The complete state of a simulation as named arrays: what a checkpoint stores.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace slagflow {

struct SavedArray {
  std::string name;              // unique
  std::size_t element_size = 0;  // [bytes]
  std::vector<std::byte> bytes;
};

using SavedState = std::vector<SavedArray>;

}  // namespace slagflow
