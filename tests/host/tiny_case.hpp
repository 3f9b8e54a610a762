// A case of 125 particles that runs in well under a second.
#pragma once

#include <string>

namespace slagflow::testing_tools {

inline std::string tiny_case(const std::string& end_time = "0.004", const std::string& departure = "remove") {
  return R"([case]
name = "tiny"
[resolution]
spacing = 2e-3
[fluid.oil]
density = 965
rheology = "bingham"
plastic_viscosity = 0.5
yield_stress = 5
growth_exponent = 10
[[region]]
shapes = [{shape = "box", min = [0, 0, 0], max = [0.01, 0.01, 0.01]}]
[[wall]]
name = "floor"
shapes = [{shape = "box", min = [-0.004, -0.004, -0.006], max = [0.014, 0.014, 0]}]
[domain]
min = [-0.005, -0.005, -0.008]
max = [0.015, 0.015, 0.02]
departure = ")" +
         departure + R"("
[numerics]
sound_speed = 5
[output]
interval = 1e-3
history_interval = 5e-4
end_time = )" +
         end_time + R"(
[[measure]]
name = "spread"
type = "front"
direction = "+x"
position = 0.0085
fraction = 0.1
[[measure]]
name = "outflow"
type = "flow_rate"
direction = "+x"
position = 0.0085
[[measure]]
name = "corner"
type = "volume"
min = [0, 0, 0]
max = [0.005, 0.005, 0.005]
[[measure]]
name = "height"
type = "profile"
start = [0.005, 0.005, 0]
end = [0.005, 0.005, 0.01]
points = 6
)";
}

// The same without a wall, all particles on their way out through the face +x.
inline std::string leaving_case(const std::string& departure) {
  std::string text = tiny_case("0.02", departure);
  const std::size_t wall = text.find("[[wall]]");
  text.replace(wall, text.find("[domain]") - wall, "velocity = [1, 0, 0]\n");
  return text;
}

}  // namespace slagflow::testing_tools
