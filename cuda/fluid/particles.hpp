// All particle data on the device. One meaning and one unit per field.
#pragma once

#include <cstdint>

#include "backend/buffer.hpp"
#include "fluid/math.hpp"

namespace slagflow {

// Fluid particles, sorted by cell, then by id.
struct FluidArrays {
  explicit FluidArrays(Context& c)
      : position(c, "fluid positions"),
        place(c, "fluid places"),
        motion(c, "fluid motions"),
        increment(c, "fluid viscous increments"),
        last_increment(c, "fluid viscous increments"),
        by_pressure(c, "fluid pressure accelerations"),
        packing(c, "fluid packings"),
        id(c, "fluid ids"),
        fluid(c, "fluid kinds"),
        state(c, "fluid states"),
        pressure(c, "fluid pressures"),
        shear_rate(c, "fluid shear rates"),
        contact(c, "contact pressures") {}

  Index count = 0;
  Buffer<Vec3d> position;       // [m] relative to the domain's lower corner, fp64: slow creep is kept
  Buffer<Quad> place;           // xyz: the same rounded [m], w: volume [m^3]
  Buffer<Quad> motion;          // xyz: velocity [m/s], w: density - rest density [kg/m^3]
  Buffer<Quad> increment;       // xyz: first guess of what the next viscous solve adds to the velocity [m/s]
  Buffer<Quad> last_increment;  // xyz: what the last one added [m/s]
  Buffer<Quad>
      by_pressure;       // xyz: force per volume by pressure in the last step [N/m^3], w: see predictor.hpp
  Buffer<Real> packing;  // density at the start over that at rest
  Buffer<Index> id;
  Buffer<std::uint8_t> fluid;  // index of the fluid
  // Set anew each step:
  Buffer<Quad> state;       // x: pressure [Pa], y: dynamic viscosity [Pa s], z: volume [m^3], w: mass [kg]
  Buffer<Real> pressure;    // [Pa]
  Buffer<Real> shear_rate;  // [1/s]
  Buffer<Real> contact;     // [Pa] the least pressure towards walls (walls/contact.hpp)

  void resize(Index n) {
    count = n;
    position.resize(n), place.resize(n), motion.resize(n), increment.resize(n), last_increment.resize(n),
        by_pressure.resize(n), packing.resize(n);
    id.resize(n), fluid.resize(n), state.resize(n), pressure.resize(n), shear_rate.resize(n);
    contact.resize(n);
  }
};

// Wall particles, sorted by cell.
struct WallArrays {
  explicit WallArrays(Context& c)
      : place(c, "wall places"),
        normal(c, "wall normals"),
        back(c, "wall back faces"),
        velocity(c, "wall velocities"),
        acceleration(c, "wall accelerations"),
        moved(c, "wall displacements"),
        pressure(c, "wall pressures"),
        tension_limit(c, "tension limits of walls"),
        id(c, "wall ids") {}

  Index count = 0;
  Buffer<Quad>
      place;  // xyz: position [m] relative to the domain's lower corner, w: 1 in a wall that vanished
  Buffer<Quad> normal;    // xyz: unit normal into the open, w: depth below the surface [m]
  Buffer<Quad> back;      // the same for the opposite face of a thin plate, or w = 0
  Buffer<Quad> velocity;  // xyz: velocity of the surface in this step [m/s], w: slip length [m], 0 no slip, <
                          // 0 free slip
  // Empty where no wall ever moves:
  Buffer<Quad> acceleration;   // xyz: of the wall's material [m/s^2]
  Buffer<Quad> moved;          // xyz: displacement in the last step [m]
  Buffer<Real> pressure;       // [Pa]
  Buffer<Real> tension_limit;  // [Pa], by id; empty where all walls have the fluid's
  Buffer<Index> id;

  void resize(Index n) {
    count = n;
    if (acceleration.size() > 0) acceleration.resize(n), moved.resize(n);
    place.resize(n), normal.resize(n), back.resize(n), velocity.resize(n), pressure.resize(n), id.resize(n);
  }
};

struct FluidView {
  Index count = 0;
  Span<const Quad> place, motion, by_pressure, state;
  Span<const Real> pressure, contact;
  Span<const std::uint8_t> fluid;
};

struct WallView {
  Index count = 0;
  Span<const Quad> place, normal, back, velocity, acceleration, moved;
  Span<const Real> pressure, tension_limit;
  Span<const Index> id;
};

inline FluidView view(const FluidArrays& f) {
  return {f.count,        f.place.span(),    f.motion.span(),  f.by_pressure.span(),
          f.state.span(), f.pressure.span(), f.contact.span(), f.fluid.span()};
}

inline WallView view(const WallArrays& w) {
  return {w.count,        w.place.span(),    w.normal.span(),
          w.back.span(),  w.velocity.span(), w.acceleration.span(),
          w.moved.span(), w.pressure.span(), w.tension_limit.span(),
          w.id.span()};
}

}  // namespace slagflow
