#include "host/run/machine_speed.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "backend/error.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/output/provenance.hpp"
#include "simulation/simulation.hpp"

namespace slagflow {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A block of a Bingham slag that slumps: 3600 particles in two dimensions, 4096 in three.
const char* const block = R"(
[case]
name = "speed"
[resolution]
spacing = 0.005
[fluid.slag]
density = 2600
rheology = "bingham"
plastic_viscosity = 1
yield_stress = 50
[[wall]]
name = "floor"
shapes = [{shape="plane", point=[0, 0, 0], normal=[0, 0, 1]}]
[output]
end_time = 1000
)";

std::string block_text(int dimensions) {
  return std::string(block) + (dimensions == 2 ? R"(
[[region]]
shapes = [{shape="box", min=[0, -1, 0], max=[0.3, 1, 0.3]}]
[domain]
min = [-0.2, -1, -0.03]
max = [0.5, 1, 0.4]
)"
                                               : R"(
[[region]]
shapes = [{shape="box", min=[0, 0, 0], max=[0.08, 0.08, 0.08]}]
[domain]
min = [-0.05, -0.05, -0.03]
max = [0.13, 0.13, 0.1]
)");
}

std::string cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
    return std::string(cache) + "/slagflow";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return std::string(home) + "/.cache/slagflow";
  return "";
}

// What a speed belongs to, as one word a blank.
std::string key_of(int dimensions) {
  const Provenance p = build_provenance();
  return std::to_string(dimensions) + "d " + std::to_string(p.threads) + " threads, " + p.version + " " +
         p.commit + ", " + p.backend + ", " + p.precision + ", " + p.build_type + ", " + p.device;
}

// A line each: speed, when it was made, what it belongs to.
MachineSpeed kept_speed(const std::string& path, const std::string& key) {
  std::ifstream file(path);
  std::string line;
  MachineSpeed speed;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    double value = 0;
    std::string made, belongs;
    if (!(words >> value >> made) || !std::getline(words >> std::ws, belongs)) continue;
    if (belongs == key && value > 0 && std::isfinite(value)) speed = {value, made, false};
  }
  return speed;
}

// Lines of other builds stay, up to some; a cache that cannot be written is none.
void keep_speed(const std::string& path, const std::string& key, const MachineSpeed& speed) {
  std::string others;
  std::ifstream before(path);
  std::string line;
  for (int k = 0; k < 100 && std::getline(before, line); ++k)
    if (line.size() < key.size() || line.compare(line.size() - key.size(), key.size(), key) != 0)
      others += line + "\n";
  before.close();
  std::error_code failed;
  fs::create_directories(fs::path(path).parent_path(), failed);
  std::ofstream file(path, std::ios::trunc);
  file << speed.particle_steps << " " << speed.made << " " << key << "\n" << others;
}

}  // namespace

double timed_speed(int dimensions) {
  constexpr double warm_up = 0.2, timed = 0.8;  // [s]
  Case c = parse_case(block_text(dimensions), "speed.toml",
                      {"resolution.dimensions=" + std::to_string(dimensions)});
  Simulation simulation(build_setup(c).setup);
  const auto seconds = [](Clock::time_point from) {
    return std::chrono::duration<double>(Clock::now() - from).count();
  };
  Clock::time_point start = Clock::now();
  while (seconds(start) < warm_up) simulation.step();
  const std::int64_t first = simulation.steps();
  start = Clock::now();
  while (seconds(start) < timed) simulation.step();
  const auto steps = static_cast<double>(simulation.steps() - first);
  return steps * static_cast<double>(simulation.particles()) / seconds(start);
}

MachineSpeed machine_speed(int dimensions, bool anew) {
  const std::string folder = cache_folder(), path = folder + "/speed", key = key_of(dimensions);
  if (!anew && !folder.empty())
    if (MachineSpeed kept = kept_speed(path, key); kept.particle_steps > 0) return kept;
  try {
    MachineSpeed speed{timed_speed(dimensions), now_utc(), true};
    if (!folder.empty()) keep_speed(path, key, speed);
    return speed;
  } catch (const Error&) {
    return {};
  }
}

double modelled_gpu_step(double particles) {
  constexpr double launches = 7e-5, each = 3.37e-9;  // [s], of tests/bench/README.md's table within 10 %
  return launches + each * particles;
}

}  // namespace slagflow
