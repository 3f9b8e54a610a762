#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "observation/penetration.hpp"

namespace slagflow {

namespace {

// 1.3: of all lattice sites around a point half a spacing deep in a wall, one at least is in the wall and as
// near as that, however the face lies.
constexpr double near_faces = 1.3;  // [spacings]

// 1 for each fluid particle that is below a face, else 0.
struct FlagBelowFaces {
  PairContext c;
  Real near;  // [m]
  Span<Offset> flag;

  HOST_DEVICE bool below(Vec3 d, Index w) const {
    const Quad front = c.wall.normal[w], back = c.wall.back[w];
    return dot(d, xyz(front)) < front.w && (!(back.w > 0) || dot(d, xyz(back)) < back.w);
  }

  HOST_DEVICE void operator()(Index i) const {
    const ListRow row = c.wall_list.entries(i);
    Real nearest = square(c.flow.support);
    bool below_any = false, below_nearest = false;
    for (Index k = 0; k < c.wall_list.length[i]; ++k) {
      const Index w = row.one(k);
      const Vec3 d = c.box.separation(xyz(c.fluid.place[i]), xyz(c.wall.place[w]));
      const Real r2 = dot(d, d);
      if (c.wall.place[w].w > 0 || (r2 >= square(near) && r2 >= nearest)) continue;
      const bool under = below(d, w);
      if (r2 < square(near) && under) below_any = true;
      if (r2 < nearest) nearest = r2, below_nearest = under;
    }
    flag[i] = below_any || (nearest >= square(near) && below_nearest) ? 1 : 0;
  }
};

struct KeepFlagged {
  Span<const Offset> flag, rank;
  Span<const Vec3d> position;
  Span<Vec3d> kept;
  HOST_DEVICE void operator()(Index i) const {
    if (flag[i] > 0) kept[rank[i]] = position[i];
  }
};

}  // namespace

BelowFaces::BelowFaces(Context& c)
    : context_(c),
      flag_(c, "flags of particles in walls"),
      rank_(c, "ranks of particles in walls"),
      kept_(c, "particles in walls") {}

std::vector<Vec3d> BelowFaces::find(const PairContext& c, Span<const Vec3d> position) {
  const Index n = c.fluid.count;
  if (n == 0 || c.wall.count == 0) return {};
  flag_.resize(n), rank_.resize(static_cast<Offset>(n) + 1);
  launch(context_, "particles in walls", n,
         FlagBelowFaces{c, static_cast<Real>(near_faces) * c.flow.spacing, flag_.span()});
  exclusive_scan(context_, flag_.span(), rank_.span());
  Offset count = 0;
  context_.copy_to_host(&count, rank_.span().data + n, sizeof count);
  if (count == 0) return {};
  kept_.resize(larger(kept_.size(), count));
  launch(context_, "particles in walls", n, KeepFlagged{flag_.span(), rank_.span(), position, kept_.span()});
  std::vector<Vec3d> result(static_cast<std::size_t>(count));
  context_.copy_to_host(result.data(), kept_.span().data, result.size() * sizeof(Vec3d));
  return result;
}

}  // namespace slagflow
