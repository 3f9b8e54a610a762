// STL files, and the surface made of them.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "backend/error.hpp"
#include "host/geometry/stl_surface.hpp"
#include "memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slagflow;
  const fuzz::MemoryFile file(data, size);
  StlSpec spec;
  spec.file = file.path(), spec.scale = 0.5, spec.translate = {1, 2, 3};
  try {
    const auto form = make_stl_form(spec);
    std::vector<Foot> feet;
    for (const Vec3d p : {Vec3d{1.1, 2.1, 3.1}, Vec3d{1, 2, 3}, Vec3d{-5, 1e9, 0}}) {
      if (std::isnan(form->distance(p))) std::abort();
      form->inner_feet(p, feet), form->outer_feet(p, feet);
    }
  } catch (const InputError&) {
  }
  return 0;
}
