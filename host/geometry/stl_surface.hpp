// A closed triangle surface as a form.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/geometry/shapes.hpp"
#include "host/geometry/stl.hpp"

namespace slagflow {

// From triangles as closed_surface gives them.
std::shared_ptr<const Form> make_surface_form(std::vector<Triangle> triangles);

// Reads, scales and moves the surface of a file. Throws InputError as read_stl and closed_surface do.
std::shared_ptr<const Form> make_stl_form(const StlSpec& spec);

}  // namespace slagflow
