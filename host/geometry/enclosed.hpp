// Fluid that moving walls crush.
#pragma once

#include <string>
#include <vector>

#include "host/case/case.hpp"
#include "host/geometry/start_sites.hpp"

namespace slagflow {

// Warns of a space that holds fluid and has no way out of the domain, of which moving walls take more until
// the end of the run than is empty, and a fiftieth of its fluid: by how far they are shifted, their faces as
// they are at the start. Rotation is left out, and walls that vanish hold nothing.
void warn_of_crushed_fluid(const Case& c, const StartSites& sites, std::vector<std::string>& warnings);

}  // namespace slagflow
