// What only the first of several ranks does: it alone touches files.
#pragma once

#include <functional>

namespace slagflow {

// Does it on the first rank, while the others wait; what it throws there, all throw. A call of all ranks.
void on_first_rank(const std::function<void()>& action);

}  // namespace slagflow
