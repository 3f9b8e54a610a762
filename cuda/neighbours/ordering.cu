#include <type_traits>

#include "backend/launch.hpp"
#include "neighbours/cell_keys.hpp"
#include "neighbours/ordering.hpp"

namespace slagflow {

namespace {

constexpr std::uint8_t inside = 255;
// Wraps periodic axes and finds the face or outlet through which a particle left.
struct FluidKey {
  CellKey of_cell;
  Vec3d extent;
  bool periodic[3];
  Span<const OutletBox> outlets;
  Span<const Index> id;
  Span<Vec3d> position;
  Span<Quad> place;
  Span<std::uint64_t> key;
  Span<Index> order;
  Span<std::uint8_t> exit;

  HOST_DEVICE void operator()(Index i) const {
    Vec3d x = position[i];
    std::uint8_t face = inside;
    for (int k = 0; k < 3; ++k) {
      if (periodic[k])
        x[k] -= extent[k] * std::floor(x[k] / extent[k]);
      else if (!(x[k] >= 0 && x[k] <= extent[k]))
        face = static_cast<std::uint8_t>(2 * k + (x[k] > extent[k] ? 1 : 0));
    }
    if (face == inside)
      if (const int outlet = outlet_at(outlets, x); outlet >= 0)
        face = static_cast<std::uint8_t>(faces + outlet);
    position[i] = x;
    const Quad rounded = quad(to_real(x), place[i].w);
    place[i] = rounded;
    exit[i] = face;
    order[i] = i;
    key[i] = face == inside ? of_cell(xyz(rounded), id[i]) : departed_key | static_cast<std::uint32_t>(id[i]);
  }
};

struct WallKey {
  PlaceKey by_place;
  Span<double> vanished;
  HOST_DEVICE void operator()(Index i) const {
    by_place(i);
    vanished[i] = by_place.place[i].w > 0 ? 1 : 0;
    if (vanished[i] > 0) by_place.key[i] = departed_key;
  }
};

template <class T>
struct Gather {
  Span<const Index> order;
  Span<const T> from;
  Span<T> to;
  HOST_DEVICE void operator()(Index i) const { to[i] = from[order[i]]; }
};

// 1 for particles of one fluid that left through one face or outlet (any face, any fluid: wildcard).
struct FlagDeparted {
  Span<const std::uint8_t> exit, fluid;
  int face, kind;  // -1: any
  Span<double> flag;
  HOST_DEVICE void operator()(Index i) const {
    const bool left = exit[i] != inside && (face < 0 || exit[i] == face) && (kind < 0 || fluid[i] == kind);
    flag[i] = left ? 1 : 0;
  }
};

}  // namespace

Ordering::Ordering(Context& c, Vec3d extent, const std::array<bool, 3>& periodic, const CellGrid& grid)
    : context_(c),
      extent_(extent),
      grid_(grid),
      slabs_(grid.planes(), grid.periodic[grid.order.axis[2]], ranks().size()),
      periodic_(periodic),
      fluid_cells_(c),
      wall_cells_(c),
      key_(c, "sort keys"),
      spare_key_(c, "sort keys"),
      order_(c, "sort order"),
      spare_order_(c, "sort order"),
      outlets_(c, "outlets"),
      cuts_(c, "cuts between ranks"),
      exit_(c, "exits"),
      flag_(c, "exit flags"),
      spare_(Buffer<Vec3d>(c, "sort spare"), Buffer<Quad>(c, "sort spare"), Buffer<double>(c, "sort spare"),
             Buffer<float>(c, "sort spare"), Buffer<Index>(c, "sort spare"),
             Buffer<std::uint8_t>(c, "sort spare")) {
  if (ranks().several()) take_cuts();
}

void Ordering::sort_keys(Index count) {
  if (sort_needs_scratch) spare_key_.resize(count), spare_order_.resize(count);
  sort_by_key(context_, key_.span(), order_.span(), {spare_key_.span(), spare_order_.span()}, 64);
}

void Ordering::reorder(const ParticleArrays& arrays, Index count) {
  arrays.each(Fate::sorted, [&](auto& values) {
    using T = typename std::decay_t<decltype(values)>::Element;
    if constexpr (sort_needs_scratch) {  // recorded launches know the array by its place
      const std::size_t bytes = sizeof(T) * static_cast<std::size_t>(count);
      auto* spare = static_cast<T*>(
          context_.workspace(sizeof(T) * static_cast<std::size_t>(larger(count, arrays.capacity()))));
      launch(context_, "reorder", count, Gather<T>{order_.span(), values.span(), {spare, count}});
      context_.copy_on_device(values.span().data, spare, bytes);
    } else {
      auto& spare = std::get<Buffer<T>>(spare_);
      spare.resize(values.size());
      launch(context_, "reorder", count, Gather<T>{order_.span(), values.span(), spare.span()});
      values.swap(spare);
    }
  });
}

Index Ordering::drop(const FluidArrays& fluid, DepartureCounts& departed) {
  auto count = [&](int face, int kind) {
    launch(context_, "exits", fluid.count,
           FlagDeparted{exit_.span(), fluid.fluid.span(), face, kind, flag_.span()});
    return static_cast<std::int64_t>(sum(context_, flag_.span()));
  };
  auto of_all = [&](std::int64_t own) { return fluid_dealt_ ? ranks().added(own) : own; };
  const std::int64_t own = count(-1, -1), all = of_all(own);
  if (all == 0) return fluid.count;
  for (std::size_t kind = 0; kind < departed.size(); ++kind) {
    for (int face = 0; face < faces; ++face)
      departed[kind][static_cast<std::size_t>(face)] += of_all(count(face, static_cast<int>(kind)));
    for (Offset outlet = 0; outlet < outlets_.size(); ++outlet)
      removed[static_cast<std::size_t>(outlet) * departed.size() + kind] +=
          of_all(count(faces + static_cast<int>(outlet), static_cast<int>(kind)));
  }
  return fluid.count - static_cast<Index>(own);
}

void Ordering::sort(FluidArrays& f, DepartureCounts& departed) {
  const Index n = f.count;
  f.resize(n);
  key_.resize(n), order_.resize(n), exit_.resize(n), flag_.resize(n);
  launch(context_, "cell keys", n,
         FluidKey{{grid_, cuts_.span()},
                  extent_,
                  {periodic_[0], periodic_[1], periodic_[2]},
                  outlets_.span(),
                  f.id.span(),
                  f.position.span(),
                  f.place.span(),
                  key_.span(),
                  order_.span(),
                  exit_.span()});
  const Index left = drop(f, departed);
  sort_keys(n);
  reorder(f, n);
  deal_out(f, fluid_cells_, left, fluid_dealt_);
  put_in_planes(f);
}

// Sums over the fluid go by planes of cells.
void Ordering::put_in_planes(FluidArrays& f) {
  f.put_in_planes({fluid_cells_.start.span(), grid_.cells_of_plane(), grid_.planes()});
}

void Ordering::find_cells(FluidArrays& f) {
  find_cells(f, fluid_cells_);
  put_in_planes(f);
}

void Ordering::sort(WallArrays& w) {
  const Index n = w.count;
  w.resize(n);
  key_.resize(n), order_.resize(n), flag_.resize(n);
  launch(context_, "wall cell keys", n,
         WallKey{{{grid_, cuts_.span()}, w.place.span(), w.id.span(), key_.span(), order_.span()},
                 flag_.span()});
  const auto left = n - static_cast<Index>(sum(context_, flag_.span()));
  sort_keys(n);
  reorder(w, n);
  deal_out(w, wall_cells_, left, walls_dealt_);
  w.put_in_planes({wall_cells_.start.span(), grid_.cells_of_plane(), grid_.planes()});
}

}  // namespace slagflow
