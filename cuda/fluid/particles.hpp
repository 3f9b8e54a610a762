// All particle data on the device. One meaning and one unit per field.
#pragma once

#include <cstdint>

#include "fluid/particle_arrays.hpp"

namespace slagflow {

// Fluid particles, sorted by cell, then by id.
struct FluidArrays : ParticleArrays {
  using ParticleArrays::ParticleArrays;

  static constexpr Fate kept = Fate::sorted | Fate::saved;
  ParticleArray<Vec3d> position{
      *this,
      {"position", "m", "from the domain's lower corner, in fp64: slow creep is kept", kept | Fate::shown}};
  ParticleArray<Quad> place{*this, {"place", "m, m^3", "xyz: the same rounded, w: volume", kept}};
  ParticleArray<Quad> motion{
      *this, {"motion", "m/s, kg/m^3", "xyz: velocity, w: density - rest density", kept | Fate::shown}};
  ParticleArray<Quad> increment{
      *this,
      {"increment", "m/s", "xyz: first guess of what the next viscous solve adds to the velocity", kept}};
  ParticleArray<Quad> last_increment{*this, {"last_increment", "m/s", "xyz: what the last one added", kept}};
  ParticleArray<Quad> by_pressure{
      *this, {"by_pressure", "N/m^3", "xyz: force per volume by pressure in the last step", kept}};
  ParticleArray<Real> hollow{
      *this,
      {"hollow", "kg/m^3", "what must close between particles that parted before pressure returns", kept}};
  ParticleArray<Real> packing{*this, {"packing", "1", "density at the start over that at rest", kept}};
  ParticleArray<Index> id{
      *this, {"id", "1", "number of the particle, constant through the run", kept | Fate::shown}};
  ParticleArray<std::uint8_t> fluid{*this, {"fluid", "1", "index of the fluid", kept | Fate::shown}};
  // Set anew in each step; what the last one left goes into snapshots.
  ParticleArray<Quad> state{
      *this, {"state", "Pa, Pa s, m^3, kg", "pressure, dynamic viscosity, volume, mass", kept | Fate::shown}};
  ParticleArray<Real> pressure{*this, {"pressure", "Pa", "pressure", kept | Fate::shown}};
  ParticleArray<Real> shear_rate{*this, {"shear_rate", "1/s", "shear rate", kept | Fate::shown}};
  ParticleArray<Real> contact{
      *this, {"contact", "Pa", "the least pressure towards walls (walls/contact.hpp)", Fate::set_anew}};
  // Empty where heat is off:
  ParticleArray<double> enthalpy{
      *this, {"enthalpy", "J/kg", "specific enthalpy above that at 298.15 K", kept | Fate::optional}};
  ParticleArray<Quad> heat{*this,
                           {"heat", "K, W/m, W/(m K), 1",
                            "temperature less that of reference, conduction potential, conductivity, solid "
                            "fraction; they follow from the enthalpy",
                            kept | Fate::shown | Fate::optional}};
  ParticleArray<Quad> melt{
      *this,
      {"melt", "Pa s, Pa, 1, Pa s",
       "of the rheology the first parameter and the yield stress, which follow from the enthalpy, 1 in solid "
       "fluid; the viscosity without the yield stress's part",
       kept | Fate::shown | Fate::optional}};
};

// Wall particles, sorted by cell. Where they are follows from the time.
struct WallArrays : ParticleArrays {
  explicit WallArrays(Context& c) : ParticleArrays(c), tension_limit(c, "tension limits of walls") {}

  ParticleArray<Quad> place{
      *this,
      {"wall_place", "m, 1", "xyz: from the domain's lower corner, w: 1 in a wall that vanished",
       Fate::sorted}};
  ParticleArray<Quad> normal{
      *this,
      {"wall_normal", "1, m", "xyz: unit normal into the open, w: depth below the surface", Fate::sorted}};
  ParticleArray<Quad> back{
      *this, {"wall_back", "1, m", "the same for the opposite face of a thin plate, or w = 0", Fate::sorted}};
  ParticleArray<Quad> velocity{
      *this,
      {"wall_velocity", "m/s, m",
       "xyz: of the wall's material there in this step, w: slip length, 0 no slip, < 0 free slip",
       Fate::sorted}};
  // Empty where no wall ever moves:
  ParticleArray<Quad> acceleration{
      *this, {"wall_acceleration", "m/s^2", "xyz: of the wall's material", Fate::sorted | Fate::optional}};
  ParticleArray<Quad> moved{
      *this, {"wall_moved", "m", "xyz: displacement in the last step", Fate::sorted | Fate::optional}};
  ParticleArray<Real> pressure{*this,
                               {"wall_pressure", "Pa", "pressure", Fate::sorted | Fate::saved | Fate::shown}};
  ParticleArray<Index> id{*this, {"wall_id", "1", "number of the particle", Fate::sorted | Fate::shown}};

  Buffer<Real> tension_limit;  // [Pa], by id; empty where all walls have the same
};

struct FluidView {
  Rows count;
  Span<const Quad> place, motion, by_pressure, state;
  Span<const Real> pressure, contact, hollow;
  Span<const std::uint8_t> fluid;
  Span<const Quad> melt;  // empty where heat is off
};

struct WallView {
  Rows count;
  Span<const Quad> place, normal, back, velocity, acceleration, moved;
  Span<const Real> pressure, tension_limit;
  Span<const Index> id;
};

inline FluidView view(const FluidArrays& f) {
  return {f.count,           f.place.span(),   f.motion.span(), f.by_pressure.span(), f.state.span(),
          f.pressure.span(), f.contact.span(), f.hollow.span(), f.fluid.span(),       f.melt.span()};
}

inline WallView view(const WallArrays& w) {
  return {w.count,        w.place.span(),    w.normal.span(),
          w.back.span(),  w.velocity.span(), w.acceleration.span(),
          w.moved.span(), w.pressure.span(), w.tension_limit.span(),
          w.id.span()};
}

}  // namespace slagflow
