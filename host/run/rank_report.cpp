#include "host/run/rank_report.hpp"

#include <algorithm>
#include <vector>

#include "backend/ranks.hpp"

namespace slagflow {

Json rank_report(const Simulation& simulation) {
  struct Share {
    std::int64_t messages, bytes, reductions, particles, copies;
    double waiting;
  };
  const RankCounts& own = ranks().counts;
  const std::vector<Share> all = ranks().gathered(
      std::vector<Share>{{own.messages, own.bytes, own.reductions, simulation.particles_of_rank(),
                          simulation.copies_of_rank(), own.waiting}});
  Share sum{}, largest{};
  for (const Share& share : all) {
    sum.messages += share.messages, sum.bytes += share.bytes, sum.particles += share.particles;
    sum.copies += share.copies;
    largest.particles = std::max(largest.particles, share.particles);
    largest.waiting = std::max(largest.waiting, share.waiting);
  }
  const double steps = static_cast<double>(std::max<std::int64_t>(simulation.steps(), 1)),
               mean = static_cast<double>(sum.particles) / static_cast<double>(all.size());
  return Json::object()
      .set("count", static_cast<std::int64_t>(all.size()))
      .set("messages_per_step", static_cast<double>(sum.messages) / steps)
      .set("bytes_per_step", static_cast<double>(sum.bytes) / steps)
      .set("reductions_per_step", static_cast<double>(own.reductions) / steps)
      .set("exchanges_per_step", static_cast<double>(own.exchanges) / steps)
      .set("copies", sum.copies)
      .set("waiting_s", largest.waiting)
      .set("largest_over_mean_particles", mean > 0 ? static_cast<double>(largest.particles) / mean : 1.0);
}

}  // namespace slagflow
