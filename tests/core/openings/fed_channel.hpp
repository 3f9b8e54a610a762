// A channel that an inlet feeds and an outlet ends.
#pragma once

#include "core/simulation_setups.hpp"
#include "fluid/constants.hpp"

namespace slagflow::testing_tools {

inline FeedRate steady(double speed) {
  FeedRate rate;
  rate.speed = {speed};
  return rate;
}

// An inlet across a channel of six by six columns, 7 long, periodic along y and z, which an outlet ends. The
// columns come at different speeds.
inline SimulationSetup fed_channel() {
  SimulationSetup s = empty_setup({0, 0, 0}, {0.12, 0.07, 0.07});
  s.domain.periodic = {false, true, true};
  s.gravity = {};
  s.fluids = {oil(), slag()};
  s.bodies = {{"tap"}};
  InletSetup in;
  in.name = "tap", in.normal = {1, 0, 0}, in.stride = dx, in.rate = steady(0.3);
  const int rows = inlet_rows(s), moving = inlet_moving_rows(s);
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 7; ++j) {
      in.origin.push_back({0.02, (j + 0.5) * dx, (k + 0.5) * dx});
      in.share.push_back(1);
      for (int row = 0; row < rows; ++row) {
        const double behind = inlet_row_place(row, moving) * dx;
        add_wall(s, in.origin.back() - Vec3d{behind, 0, 0}, {row < moving ? 1.0 : -1.0, 0, 0},
                 row < moving ? behind : (rows - 2) * dx - behind);
      }
    }
  s.inlets = {in};
  s.outlets = {{"end", {0.09, -1, -1}, {1, 1, 1}}};
  return s;
}

}  // namespace slagflow::testing_tools
