// Checkpoints: the bytes as a file; the same under a good seal, so that what lies behind it is reached; and
// as changes to the saved arrays of a sound state, which a simulation then takes up.
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "backend/error.hpp"
#include "core/simulation_setups.hpp"
#include "host/output/checkpoint.hpp"
#include "memory_file.hpp"

namespace {

using namespace slagflow;

void read(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file(data, size);
  try {
    read_checkpoint(file.path());
  } catch (const Error&) {
  }
}

void read_sealed(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  const std::uint64_t sum = checksum(data, size);
  bytes.resize(size + 16);
  std::memcpy(&bytes[size], "SLAGSEAL", 8);
  std::memcpy(&bytes[size + 8], &sum, 8);
  read(bytes.data(), bytes.size());
}

// Each change is five bytes: the array, a place in it (2), a value, and whether it is put or ends the array.
void restore_changed(const std::uint8_t* data, std::size_t size) {
  static const SimulationSetup setup = testing_tools::dam();
  static const SavedState sound = [] {
    Simulation simulation(setup);
    for (int k = 0; k < 3; ++k) simulation.step();
    return simulation.save();
  }();
  static Simulation simulation(setup);
  SavedState state = sound;
  for (std::size_t k = 0; k + 5 <= size; k += 5) {
    SavedArray& array = state[data[k] % state.size()];
    const std::size_t place = data[k + 1] + 256u * data[k + 2];
    if (array.bytes.empty()) continue;
    if (data[k + 4] % 16 == 15)
      array.bytes.resize(place % array.bytes.size());
    else
      array.bytes[place % array.bytes.size()] = static_cast<std::byte>(data[k + 3]);
  }
  try {
    simulation.restore(state);
    simulation.step(), simulation.step();
  } catch (const Error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  switch (data[0] % 3) {
    case 0:
      read(data + 1, size - 1);
      break;
    case 1:
      read_sealed(data + 1, size - 1);
      break;
    default:
      restore_changed(data + 1, size - 1);
  }
  return 0;
}
