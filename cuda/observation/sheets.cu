#include "backend/launch.hpp"
#include "fluid/diagnostic_sums.hpp"
#include "fluid/lane_math.hpp"
#include "observation/sheets.hpp"

namespace slagflow {

namespace {

struct Axis {
  Real spread;  // diagonal element
  Vec3 direction;
};

// Jacobi's rotation of the axes p and q that makes the element pq zero; rp, rq: those with the third axis.
HOST_DEVICE inline void rotate(Axis& p, Axis& q, Real& pq, Real& rp, Real& rq) {
  if (pq == 0) return;
  const Real theta = (q.spread - p.spread) / (2 * pq);
  const Real t = (theta < 0 ? Real(-1) : Real(1)) / (std::fabs(theta) + std::sqrt(square(theta) + 1));
  const Real c = 1 / std::sqrt(square(t) + 1), s = t * c, before = rp;
  p.spread -= t * pq, q.spread += t * pq, pq = 0;
  rp = c * before - s * rq, rq = s * before + c * rq;
  const Vec3 old = p.direction;
  p.direction = c * old - s * q.direction, q.direction = s * old + c * q.direction;
}

template <class Box>
struct Pairs {
  PairContext c;
  Box box;

  // visit(x_ij, which lanes are within the support, j)
  template <class Visit>
  HOST_DEVICE void each(Index i, Visit visit) const {
    const LaneVec3 x = in_lanes(xyz(c.fluid.place[i]));
    const ListRow row = c.fluid_list.entries(i);
    const Index pairs = c.fluid_list.length[i];
    for (Index k = 0; k < pairs; k += lane_count) {
      const Entries j = row[k];
      const LaneVec3 d = box.separation(x, xyz(gather(c.fluid.place, j)));
      visit(d, (dot(d, d) < Lanes(square(c.flow.support))) & first_lanes(pairs - k), j);
    }
  }
};

template <class Box>
struct SeenThickness {
  Pairs<Box> pairs;
  Real most;   // [m] that can be told
  Real crowd;  // particles within the support radius of one that is not in a thin sheet
  Span<Real> seen;

  // Of the places of the particle and its neighbours about their mean.
  struct Spread {
    Symmetric3 about_mean;
    Real count;
  };
  HOST_DEVICE Spread spread(Index i) const {
    LaneVec3 sum;
    SymmetricMatrix3<Lanes> squares;
    Lanes count = 1;
    pairs.each(i, [&](LaneVec3 d, LaneMask near, const Entries&) {
      const Lanes one = select(near, Lanes(1), Lanes(0));
      sum += one * d, count += one;
      squares.add_outer(one, d);
    });
    Spread all{total(squares), total(count) - Real(lane_count - 1)};
    all.about_mean.add_outer(-1 / all.count, total(sum));
    if (pairs.c.flow.dimensions == 2)  // not the axis across the plane
      all.about_mean.yy = 2 * (all.about_mean.xx + all.about_mean.zz);
    return all;
  }

  HOST_DEVICE void operator()(Index i) const {
    const Spread all = spread(i);
    if (all.count >= crowd) {
      seen[i] = most;
      return;
    }
    const LaneVec3 axis = in_lanes(least_axis(all.about_mean));
    Lanes low = 0, high = 0;
    pairs.each(i, [&](LaneVec3 d, LaneMask near, const Entries&) {
      const Lanes along = select(near, dot(d, axis), Lanes(0));
      low = smaller(low, along), high = smaller(high, Lanes(0) - along);
    });
    seen[i] = smaller(most, pairs.c.flow.spacing - least(low) - least(high));
  }
};

template <class Box>
struct LargestSeen {
  Pairs<Box> pairs;
  Real most_told;  // [m]
  Span<const Real> seen;
  Span<Real> thickness;
  HOST_DEVICE void operator()(Index i) const {
    if (seen[i] >= most_told) {
      thickness[i] = seen[i];
      return;
    }
    Lanes most = -seen[i];
    pairs.each(i, [&](LaneVec3, LaneMask near, const Entries& j) {
      most = smaller(most, select(near, Lanes(0) - gather(seen, j), most));
    });
    thickness[i] = -least(most);
  }
};

struct IsThin {
  Span<const Real> thickness;
  Real limit;
  HOST_DEVICE double operator()(Index i) const { return thickness[i] < limit ? 1 : 0; }
};

}  // namespace

HOST_DEVICE Vec3 least_axis(Symmetric3 a) {
  constexpr int sweeps = 4;
  Axis x{a.xx, {1, 0, 0}}, y{a.yy, {0, 1, 0}}, z{a.zz, {0, 0, 1}};
  for (int k = 0; k < sweeps; ++k) {
    rotate(x, y, a.xy, a.xz, a.yz);
    rotate(x, z, a.xz, a.xy, a.yz);
    rotate(y, z, a.yz, a.xy, a.xz);
  }
  if (x.spread <= y.spread && x.spread <= z.spread) return x.direction;
  return y.spread <= z.spread ? y.direction : z.direction;
}

SheetThickness::SheetThickness(Context& c)
    : context_(c), seen_(c, "thickness seen"), thickness_(c, "sheet thickness") {}

const Buffer<Real>& SheetThickness::measure(const PairContext& c) {
  const Rows n = c.fluid.count;
  seen_.resize(c.fluid.place.size), thickness_.resize(n);
  // In the middle of three layers of a lattice a particle sees 63 of the 81 that it sees inside; their volume
  // asks for 73.6.
  constexpr double told = 4.5, share = 0.93, pi = 3.14159265358979;
  const double radius = static_cast<double>(c.flow.support / c.flow.spacing);
  const double inside = c.flow.dimensions == 2 ? pi * square(radius) : 4.0 / 3 * pi * radius * square(radius);
  const auto most = static_cast<Real>(told) * c.flow.spacing, crowd = static_cast<Real>(share * inside);
  auto sweep = [&](auto box) {
    using Box = decltype(box);
    launch(context_, "thickness seen", n, SeenThickness<Box>{{c, box}, most, crowd, seen_.span()});
    exchange(context_, n, seen_);
    launch(context_, "sheet thickness", n, LargestSeen<Box>{{c, box}, most, seen_.span(), thickness_.span()});
  };
  c.box.any() ? sweep(c.box) : sweep(OpenBox{});
  return thickness_;
}

void SheetThickness::count_thin(const PairContext& c, GatheredSums& sums, std::int64_t& count) {
  const Span<const Real> thickness = measure(c).span();
  gather_count(sums, c.fluid.count, IsThin{thickness, static_cast<Real>(thin_sheet) * c.flow.spacing},
               [&count](std::int64_t all) { count = all; });
}

}  // namespace slagflow
