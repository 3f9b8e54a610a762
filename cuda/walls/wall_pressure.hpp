// The pressure that a wall particle shows its neighbours.
#pragma once

#include "neighbours/pairs.hpp"

namespace slagflow {

// p_w = max(-p_t, sum_f [p_f + rho_f (g - a_w).(x_w - x_f)] W_wf / sum_f W_wf)   [Pa], over the fluid
// particles in reach, a_w the acceleration of the wall's material; zero where there are none. Where walls
// have limits of their own, p_t is the wall's and p_f cut off there too (wall_tension.hpp). S. Adami et al.,
// J. Comput. Phys. 231 (2012) 7057. `list`: for each wall particle, the fluid particles in reach.
void extrapolate_wall_pressure(Context&, const PairContext&, const ListView& list, WallArrays&);

}  // namespace slagflow
