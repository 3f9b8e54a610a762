#include "fluid/constants.hpp"
#include "fluid/diagnostic_sums.hpp"
#include "observation/rectangles.hpp"

namespace slagflow {

namespace {

// Once along the normal and once against it, for particles of one fluid.
struct Passages {
  static constexpr int terms = 2;
  Span<const Quad> before, now;
  Span<const std::uint8_t> fluid;
  std::uint8_t kind;
  PeriodicBox box;
  Vec3 center, normal, u, v;
  Real half_u, half_v;

  // Both ends of the way, from one image of the rectangle: ways across a periodic face count, and the end of
  // one is to the bit the start of the next.
  HOST_DEVICE Terms<2> operator()(Index i) const {
    const Vec3 from = box.separation(xyz(before[i]), center), near = box.separation(xyz(now[i]), center);
    const Vec3 way = near - from;
    const Vec3 to = near - (way - box.separation(way, {}));
    const Real a = dot(normal, from), b = dot(normal, to);
    const bool passes = fluid[i] == kind && (a < 0) != (b < 0);
    if (!passes) return {{0, 0}};
    const Vec3 at = from + (a / (a - b)) * (to - from);
    if (absolute(dot(u, at)) > half_u || absolute(dot(v, at)) > half_v) return {{0, 0}};
    return {{a < 0 ? 1.0 : 0.0, a < 0 ? 0.0 : 1.0}};
  }
  HOST_DEVICE static Real absolute(Real x) { return x < 0 ? -x : x; }
};

}  // namespace

FluxCounters::FluxCounters(Context& c, const SimulationSetup& s)
    : rectangles_(s.rectangles),
      box_(periodic_box(s)),
      fluids_(s.fluids.size()),
      counts_(2 * rectangles_.size() * fluids_),
      before_(c, "places of the last count") {
  for (RectangleSetup& r : rectangles_) r.center -= s.domain.lower;
}

void FluxCounters::start(const FluidArrays& f) {
  if (any()) before_.copy_from(f.place);
  way_ = 0;
}

void FluxCounters::count(Context& c, const FluidArrays& f, DiagnosticScratch& scratch) {
  GatheredSums sums(c, scratch);
  std::vector<FluxState> now;
  states(f, sums, now);
  sums.read();
  for (std::size_t k = 0; k < now.size(); ++k)
    for (std::size_t kind = 0; kind < fluids_; ++kind) {
      counts_[2 * (k * fluids_ + kind)] = now[k].forward[kind];
      counts_[2 * (k * fluids_ + kind) + 1] = now[k].backward[kind];
    }
}

void FluxCounters::follow(Context& c, const FluidArrays& f, double way, double most,
                          DiagnosticScratch& scratch) {
  way_ += way;
  if (!any() || way_ <= most) return;
  count(c, f, scratch);
  start(f);
}

void FluxCounters::states(const FluidArrays& f, GatheredSums& sums, std::vector<FluxState>& states) const {
  states.assign(rectangles_.size(), {std::vector<std::int64_t>(fluids_), std::vector<std::int64_t>(fluids_)});
  for (std::size_t k = 0; k < states.size(); ++k)
    for (std::size_t kind = 0; kind < fluids_; ++kind) {
      const RectangleSetup& r = rectangles_[k];
      const Passages body{before_.span(),
                          f.place.span(),
                          f.fluid.span(),
                          static_cast<std::uint8_t>(kind),
                          box_,
                          to_real(r.center),
                          to_real(r.normal),
                          to_real(r.u),
                          to_real(r.v),
                          static_cast<Real>(r.half_u),
                          static_cast<Real>(r.half_v)};
      const std::int64_t* before_that = &counts_[2 * (k * fluids_ + kind)];
      gather_terms<AddUp>(
          sums, f.count, body, [&state = states[k], kind, before_that](const Terms<2>& passed) {
            state.forward[kind] = before_that[0] + static_cast<std::int64_t>(passed.value[0]);
            state.backward[kind] = before_that[1] + static_cast<std::int64_t>(passed.value[1]);
          });
    }
}

}  // namespace slagflow
