// Particle arrays of a given length that hold zeros: sorting moves every field, also those that a test does
// not use.
#pragma once

#include <vector>

#include "fluid/particles.hpp"

namespace slagflow {

inline void clear(FluidArrays& f, std::size_t count) {
  f.resize(static_cast<Index>(count));
  f.position.upload(std::vector<Vec3d>(count));
  for (Buffer<Quad>* field : {&f.place, &f.motion, &f.increment, &f.last_increment, &f.by_pressure, &f.state})
    field->upload(std::vector<Quad>(count));
  f.id.upload(std::vector<Index>(count));
  f.fluid.upload(std::vector<std::uint8_t>(count));
  for (Buffer<Real>* field : {&f.packing, &f.pressure, &f.shear_rate})
    field->upload(std::vector<Real>(count));
}

inline void clear(WallArrays& w, std::size_t count) {
  w.resize(static_cast<Index>(count));
  for (Buffer<Quad>* field : {&w.place, &w.normal, &w.back, &w.velocity})
    field->upload(std::vector<Quad>(count));
  w.pressure.upload(std::vector<Real>(count));
  w.id.upload(std::vector<Index>(count));
}

}  // namespace slagflow
