#include <algorithm>
#include <cmath>
#include <limits>

#include "backend/primitives.hpp"
#include "fluid/diagnostic_sums.hpp"
#include "observation/residence.hpp"

namespace slagflow {

namespace {

struct FindLeaving {
  Span<const Vec3d> position;
  Span<const OutletBox> outlets;
  Span<Offset> leaving;
  HOST_DEVICE void operator()(Index i) const { leaving[i] = outlet_at(outlets, position[i]) >= 0 ? 1 : 0; }
};

struct Leaves {
  Span<const Offset> leaving;
  HOST_DEVICE double operator()(Index i) const { return static_cast<double>(leaving[i]); }
};

struct GatherLeaving {
  Span<const Vec3d> position;
  Span<const OutletBox> outlets;
  Span<const Index> id;
  Span<const Offset> rank;
  Span<Index> left_id;
  Span<std::uint8_t> left_by;
  HOST_DEVICE void operator()(Index i) const {
    if (rank[i] == rank[i + 1]) return;
    left_id[rank[i]] = id[i];
    left_by[rank[i]] = static_cast<std::uint8_t>(outlet_at(outlets, position[i]));
  }
};

// The time of the last row that is not beyond the id.
struct Age {
  Span<const Index> id, first;
  Span<const double> time;
  double now;
  HOST_DEVICE double operator()(Index i) const {
    Offset low = 0, high = first.size;
    while (high - low > 1) {
      const Offset middle = (low + high) / 2;
      (first[middle] <= id[i] ? low : high) = middle;
    }
    return now - time[low];
  }
};

ResidenceState state_of(std::vector<float> ages) {
  constexpr double shares[5] = {0.05, 0.25, 0.5, 0.75, 0.95};
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  ResidenceState state;
  state.left = static_cast<std::int64_t>(ages.size());
  state.mean = state.deviation = unknown;
  state.percentiles.fill(unknown);
  if (ages.empty()) return state;
  std::sort(ages.begin(), ages.end());
  double sum = 0, squares = 0;
  for (const float age : ages) sum += static_cast<double>(age);
  state.mean = sum / static_cast<double>(ages.size());
  for (const float age : ages) squares += square(static_cast<double>(age) - state.mean);
  state.deviation = std::sqrt(squares / static_cast<double>(ages.size()));
  const auto last = static_cast<double>(ages.size() - 1);
  for (std::size_t k = 0; k < state.percentiles.size(); ++k)
    state.percentiles[k] =
        static_cast<double>(ages[static_cast<std::size_t>(std::llround(shares[k] * last))]);
  return state;
}

}  // namespace

Residence::Residence(Context& c)
    : context_(c),
      first_on_device_(c, "ids of entries"),
      time_on_device_(c, "times of entries"),
      leaving_(c, "leaving particles"),
      rank_(c, "ranks of leaving particles"),
      id_(c, "ids of leaving particles"),
      outlet_(c, "outlets of leaving particles") {}

void Residence::start(const SimulationSetup& s) {
  outlets_ = s.residences;
  enter(0, s.start_time);
}

void Residence::enter(Index first_id, double now) {
  if (!any()) return;
  first_.push_back(first_id), time_.push_back(now);
}

void Residence::leave(const FluidArrays& f, Span<const OutletBox> outlets, double now,
                      DiagnosticScratch& scratch) {
  if (!any() || f.count.of_all() == 0) return;
  const auto n = static_cast<Offset>(f.count);
  leaving_.resize(n), rank_.resize(n + 1);
  launch(context_, "leaving particles", f.count, FindLeaving{f.position.span(), outlets, leaving_.span()});
  const std::int64_t all = count(context_, scratch, f.count, Leaves{leaving_.span()});
  if (all == 0) return;
  exclusive_scan(context_, leaving_.span(), rank_.span());
  Offset own = 0;
  context_.copy_to_host(&own, rank_.span().data + n, sizeof own);
  id_.resize(own), outlet_.resize(own);
  launch(context_, "gather leaving particles", f.count,
         GatherLeaving{f.position.span(), outlets, f.id.span(), rank_.span(), id_.span(), outlet_.span()});
  std::vector<Index> ids;
  std::vector<std::uint8_t> by;
  id_.download(ids), outlet_.download(by);
  ids = ranks().gathered(ids), by = ranks().gathered(by);
  const auto rows = static_cast<Offset>(first_.size());
  const Age age{{ids.data(), static_cast<Offset>(all)}, {first_.data(), rows}, {time_.data(), rows}, now};
  for (std::size_t k = 0; k < ids.size(); ++k) {
    age_.push_back(static_cast<float>(age(static_cast<Index>(k))));
    left_by_.push_back(by[k]);
  }
}

void Residence::states(const FluidArrays& f, double now, GatheredSums& sums,
                       std::vector<ResidenceState>& states) {
  if (!any()) return;
  first_on_device_.upload(first_), time_on_device_.upload(time_);
  for (const std::size_t outlet : outlets_) {
    std::vector<float> ages;
    for (std::size_t k = 0; k < age_.size(); ++k)
      if (left_by_[k] == outlet) ages.push_back(age_[k]);
    states.push_back(state_of(std::move(ages)));
  }
  gather_total(sums, f.count, Age{f.id.span(), first_on_device_.span(), time_on_device_.span(), now},
               [&states, count = static_cast<double>(f.count.of_all())](double all) {
                 for (ResidenceState& state : states) state.mean_inside = all / count;
               });
}

}  // namespace slagflow
