#include <algorithm>
#include <cmath>

#include "backend/launch.hpp"
#include "fluid/constants.hpp"
#include "openings/inlets.hpp"

namespace slagflow {

namespace {

struct PlaceColumns {
  Index first, rows, moving_rows;
  double inverse_dt;
  Span<const Inlets::Moment> moments;
  Span<const std::uint8_t> inlet;
  Span<const Vec3d> origin;
  Span<const double> share, retreat;
  Span<const Index> id;
  Span<Quad> place, velocity, acceleration, moved;

  HOST_DEVICE void operator()(Index i) const {
    if (id[i] < first) return;
    const Index column = (id[i] - first) / rows, row = (id[i] - first) % rows;
    const Inlets::Moment& m = moments[inlet[column]];
    const bool moves = row < moving_rows;
    const double s = moves ? share[column] : 0;
    const double back = moves ? retreat[column] + (row + 0.5) * m.stride : (row - 1.5) * m.stride;
    const double way = s * m.travelled - back;
    place[i] = quad(to_real(origin[column] + way * m.normal), 0);
    // The last two rows that move are felt as at rest, as are those that stay: they only close the way
    // between.
    const double felt = row < moving_rows - 2 ? s : 0;
    velocity[i] = quad(to_real((felt * m.gain * inverse_dt) * m.normal), 0);
    acceleration[i] = quad(to_real((felt * m.acceleration) * m.normal), 0);
    moved[i] = quad(to_real((felt * m.gained) * m.normal), 0);
  }
};

// Pressures of the foremost particles, by column.
struct TakePressure {
  Index first, rows;
  Span<const Index> id;
  Span<const Real> from;
  Span<Real> pressure;
  HOST_DEVICE void operator()(Index i) const {
    if (id[i] >= first && (id[i] - first) % rows == 0) pressure[(id[i] - first) / rows] = from[i];
  }
};

// New fluid k, as if it had been there from the start.
struct FeedParticle {
  Index before, next_id;
  Span<const Vec3d> new_position;
  Span<const Quad> new_motion;
  Span<const Index> column;
  Span<const std::uint8_t> new_kind;
  Span<const Real> column_pressure;
  Span<const FluidConstants> fluids;
  Real sound_speed_squared;
  Vec3 gravity;
  Span<Vec3d> position;
  Span<Quad> place, motion, increment, last_increment, by_pressure, state;
  Span<Real> hollow, packing, pressure, shear_rate, contact;
  Span<Index> id;
  Span<std::uint8_t> kind;

  HOST_DEVICE void operator()(Index k) const {
    const Index i = before + k;
    const FluidConstants& f = fluids[new_kind[k]];
    const Real p = larger(column_pressure[column[k]], Real(0)), excess = p / sound_speed_squared;
    const Real density_ratio = 1 + excess / f.rest_density, volume = f.volume(excess, density_ratio);
    position[i] = new_position[k];
    place[i] = quad(to_real(new_position[k]), volume);
    motion[i] = quad(xyz(new_motion[k]), excess);
    increment[i] = last_increment[i] = quad(Vec3{}, 0);
    by_pressure[i] = quad(-f.rest_density * gravity, 0);
    state[i] = {p, viscosity(f.rheology, 0), volume, f.mass};
    hollow[i] = 0, packing[i] = density_ratio;
    pressure[i] = p, shear_rate[i] = 0, contact[i] = 0;
    id[i] = next_id + k, kind[i] = new_kind[k];
  }
};

}  // namespace

Inlets::Inlets(Context& c)
    : context_(c),
      moment_(c, "inlets now"),
      origin_(c, "columns of inlets"),
      share_(c, "speeds of columns"),
      retreat_(c, "rows fed by columns"),
      inlet_(c, "inlets of columns"),
      pressure_(c, "pressures of columns"),
      position_(c, "fed places"),
      motion_(c, "fed velocities"),
      column_(c, "fed columns"),
      kind_(c, "fed fluids") {}

void Inlets::upload(const SimulationSetup& setup) {
  inlets_ = setup.inlets;
  if (!any()) return;
  lower_ = setup.domain.lower;
  rows_ = static_cast<std::size_t>(inlet_rows(setup)), moving_rows_ = inlet_moving_rows(setup);
  std::vector<Vec3d> origin;
  std::vector<double> share;
  std::vector<std::uint8_t> inlet;
  for (std::size_t k = 0; k < inlets_.size(); ++k) {
    const InletSetup& in = inlets_[k];
    for (std::size_t c = 0; c < in.origin.size(); ++c) {
      columns_.push_back({k, in.origin[c] - lower_, in.share[c], 0, 0});
      origin.push_back(columns_.back().origin), share.push_back(in.share[c]);
      inlet.push_back(static_cast<std::uint8_t>(k));
    }
    largest_share_.push_back(*std::max_element(in.share.begin(), in.share.end()));
  }
  first_wall_ = setup.walls.position.size() - columns_.size() * rows_;
  origin_.upload(origin), share_.upload(share), inlet_.upload(inlet);
  pressure_.upload(std::vector<Real>(columns_.size()));
  for (Column& c : columns_) c.rows_at_start = rows_by(c, setup.start_time);
  fed_at(setup.start_time);
}

std::int64_t Inlets::rows_by(const Column& c, double time) const {
  const InletSetup& in = inlets_[c.inlet];
  return static_cast<std::int64_t>(std::floor(c.share * in.rate.travelled(time) / in.stride + 0.5));
}

void Inlets::fed_at(double time) {
  for (Column& c : columns_) c.rows = rows_by(c, time);
  upload_rows();
}

void Inlets::upload_rows() {
  if (!any()) return;
  std::vector<double> retreat;
  retreat.reserve(columns_.size());
  for (const Column& c : columns_) retreat.push_back(static_cast<double>(c.rows) * inlets_[c.inlet].stride);
  retreat_.upload(retreat);
}

void Inlets::place(const WallStep& step, WallArrays& wall) {
  if (!any()) return;
  std::vector<Moment> now;
  speed_ = 0;
  for (std::size_t k = 0; k < inlets_.size(); ++k) {
    const FeedRate& rate = inlets_[k].rate;
    const double here = rate.travelled(step.now), then = rate.travelled(step.now + step.dt);
    Moment m{inlets_[k].normal,
             inlets_[k].stride,
             here,
             then - here,
             here - rate.travelled(step.now - step.last_dt),
             0};
    // As of other walls, a jump at the start or stop is left out.
    if (rate.at(step.now) > 0 && rate.at(step.now + step.dt) > 0)
      m.acceleration = (rate.at(step.now + step.dt) - rate.at(step.now)) / step.dt;
    speed_ = larger(speed_, largest_share_[k] * m.gain / step.dt);
    now.push_back(m);
  }
  moment_.upload(now);
  launch(context_, "place inlets", wall.local(),
         PlaceColumns{static_cast<Index>(first_wall_), static_cast<Index>(rows_),
                      static_cast<Index>(moving_rows_), 1 / step.dt, moment_.span(), inlet_.span(),
                      origin_.span(), share_.span(), retreat_.span(), wall.id.span(), wall.place.span(),
                      wall.velocity.span(), wall.acceleration.span(), wall.moved.span()});
}

FedParticles Inlets::take_rows(double now, double last_dt) {
  FedParticles fed;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    Column& c = columns_[k];
    const InletSetup& in = inlets_[c.inlet];
    const double way = c.share * in.rate.travelled(now);
    const double speed = last_dt > 0 ? (way - c.share * in.rate.travelled(now - last_dt)) / last_dt
                                     : c.share * in.rate.at(now);
    for (const std::int64_t all = rows_by(c, now); c.rows < all; ++c.rows) {
      fed.position.push_back(c.origin + (way - (static_cast<double>(c.rows) + 0.5) * in.stride) * in.normal);
      fed.fluid.push_back(in.fluid);
      fed.motion.push_back(quad(to_real(speed * in.normal), 0));
      fed.column.push_back(static_cast<Index>(k));
      fed.inlet.push_back(c.inlet);
    }
  }
  return fed;
}

// Of the columns; each is where its foremost particle is.
void Inlets::take_pressures(const WallArrays& wall) {
  if (ranks().several()) pressure_.upload(std::vector<Real>(columns_.size()));
  launch(context_, "pressures of inlets", wall.count,
         TakePressure{static_cast<Index>(first_wall_), static_cast<Index>(rows_), wall.id.span(),
                      wall.pressure.span(), pressure_.span()});
  if (!ranks().several()) return;
  std::vector<Real> pressure;
  pressure_.download(pressure);
  ranks().join(pressure.data(), pressure.size() * sizeof(Real));
  pressure_.upload(pressure);
}

FedParticles Inlets::feed(const Feeding& at, const WallArrays& wall, Span<const FluidConstants> fluids,
                          const FlowConstants& flow, FluidArrays& fluid) {
  FedParticles fed = take_rows(at.now, at.last_dt);
  const auto count = static_cast<Index>(fed.column.size());
  if (count == 0) return fed;
  upload_rows();
  take_pressures(wall);
  if (!ranks().first()) return fed;  // from where they go to the rank that has their place
  const Index before = fluid.count;
  position_.upload(fed.position), motion_.upload(fed.motion);
  column_.upload(fed.column), kind_.upload(fed.fluid);
  fluid.resize(before + count);
  launch(context_, "feed", count,
         FeedParticle{before,
                      at.next_id,
                      position_.span(),
                      motion_.span(),
                      column_.span(),
                      kind_.span(),
                      pressure_.span(),
                      fluids,
                      flow.sound_speed_squared,
                      flow.gravity,
                      fluid.position.span(),
                      fluid.place.span(),
                      fluid.motion.span(),
                      fluid.increment.span(),
                      fluid.last_increment.span(),
                      fluid.by_pressure.span(),
                      fluid.state.span(),
                      fluid.hollow.span(),
                      fluid.packing.span(),
                      fluid.pressure.span(),
                      fluid.shear_rate.span(),
                      fluid.contact.span(),
                      fluid.id.span(),
                      fluid.fluid.span()});
  return fed;
}

bool Inlets::overdue(double now) const {
  std::size_t due = 0;
  for (const Column& c : columns_) {
    const InletSetup& in = inlets_[c.inlet];
    const double ahead = c.share * in.rate.travelled(now) / in.stride - static_cast<double>(c.rows);
    if (ahead > 1) return true;
    if (ahead >= 0.5) ++due;
  }
  return 4 * due > columns_.size();
}

std::vector<std::int64_t> Inlets::fed() const {
  std::vector<std::int64_t> result(inlets_.size());
  for (const Column& c : columns_) result[c.inlet] += c.rows - c.rows_at_start;
  return result;
}

std::int64_t Inlets::all_fed() const {
  std::int64_t all = 0;
  for (const std::int64_t count : fed()) all += count;
  return all;
}

Vec3d Inlets::position_at(std::size_t wall_particle, double time, double list_time) const {
  const std::size_t k = wall_particle - first_wall_;
  const Column& c = columns_[k / rows_];
  const InletSetup& in = inlets_[c.inlet];
  const int row = static_cast<int>(k % rows_);
  double way = -inlet_row_place(row, moving_rows_) * in.stride;
  if (row < moving_rows_)
    way += c.share * in.rate.travelled(time) - static_cast<double>(rows_by(c, list_time)) * in.stride;
  return lower_ + c.origin + way * in.normal;
}

double Inlets::largest_displacement(double from, double to) const {
  double largest = 0;
  for (std::size_t k = 0; k < inlets_.size(); ++k)
    largest = larger(largest,
                     largest_share_[k] * (inlets_[k].rate.travelled(to) - inlets_[k].rate.travelled(from)));
  return largest;
}

}  // namespace slagflow
