// Of the particles each rank keeps those of its slab.
#include <cstdlib>
#include <cstring>
#include <string>

#include "backend/launch.hpp"
#include "backend/primitives.hpp"
#include "fluid/migration.hpp"
#include "neighbours/cell_keys.hpp"
#include "neighbours/ordering.hpp"

namespace slagflow {

namespace {

// How many rows, sorted by cell, are before a cell.
Index rows_before(Context& context, const CellRanges& cells, Index cell) {
  Index row = 0;
  context.copy_to_host(&row, cells.start.span().data + cell, sizeof row);
  return row;
}

// Of each of a rank's own planes the rows.
std::vector<std::int64_t> rows_of_planes(Context& context, const CellRanges& cells, const CellGrid& grid) {
  std::vector<std::int64_t> rows;
  for (int plane = 0; plane < grid.slab.own; ++plane)
    rows.push_back(rows_before(context, cells, (plane + 1) * grid.cells_of_plane()) -
                   rows_before(context, cells, plane * grid.cells_of_plane()));
  return rows;
}

// A particle of a wall costs a rank a quarter of what one of the fluid does, most have no fluid near.
constexpr std::int64_t of_fluid = 4, of_wall = 1;

// For tests: a number, and cuts are at random at each build.
std::uint64_t random_cuts() {
  static const char* const wish = std::getenv("SLAGFLOW_RANDOM_CUTS");
  static std::uint64_t next = wish != nullptr ? std::strtoull(wish, nullptr, 10) : 0;
  return wish != nullptr ? ++next : 0;
}

}  // namespace

void Ordering::take_cuts() {
  grid_.slab = slabs_.of(ranks().rank());
  cuts_.upload(slabs_.cuts());
}

void Ordering::deal_out(const std::vector<Vec3d>& fluid, const std::vector<Vec3d>& walls) {
  if (!ranks().several()) return;
  std::vector<std::int64_t> weight(static_cast<std::size_t>(slabs_.planes()));
  const auto add = [&](const std::vector<Vec3d>& places, std::int64_t each) {
    for (const Vec3d& x : places) weight[static_cast<std::size_t>(grid_.plane_at(to_real(x)))] += each;
  };
  add(fluid, of_fluid), add(walls, of_wall);
  slabs_.balance(weight);
  take_cuts();
  fluid_dealt_ = true;
}

bool Ordering::owns(Vec3d place) const {
  const int plane = grid_.local_plane(grid_.plane_at(to_real(place)));
  return plane >= 0 && plane < grid_.slab.own;
}

Ordering::Dealt Ordering::deal_out(const std::vector<Quad>& places) {
  if (!ranks().several()) return {static_cast<Index>(places.size()), {}};
  std::vector<std::int64_t> rows(static_cast<std::size_t>(slabs_.planes()));
  for (const Quad& place : places) ++rows[static_cast<std::size_t>(grid_.plane_at(xyz(place)))];
  slabs_.balance(rows);
  take_cuts();
  const Slab& slab = grid_.slab;
  const auto of_planes = [&](int first, int count) {
    Index sum = 0;
    for (int p = first; p < first + count; ++p) sum += static_cast<Index>(rows[static_cast<std::size_t>(p)]);
    return sum;
  };
  const int border = halo_planes < slab.own ? halo_planes : slab.own;
  return {of_planes(slab.first, slab.own),
          {of_planes(slab.first, border), of_planes(slab.first + slab.own - border, border)}};
}

bool Ordering::balance() {
  if (!ranks().several()) return false;
  bool moved = false;
  if (const std::uint64_t seed = random_cuts(); seed > 0) {
    slabs_.shuffle(seed);
    moved = true;
  } else {
    const auto fluid = rows_of_planes(context_, fluid_cells_, grid_),
               walls = rows_of_planes(context_, wall_cells_, grid_);
    std::vector<std::int64_t> own;
    for (std::size_t p = 0; p < fluid.size(); ++p) own.push_back(of_fluid * fluid[p] + of_wall * walls[p]);
    const std::vector<std::byte> all = ranks().gathered(own.data(), own.size() * sizeof(std::int64_t));
    std::vector<std::int64_t> weight(static_cast<std::size_t>(slabs_.planes()));
    std::memcpy(weight.data(), all.data(), all.size());
    moved = slabs_.balance(weight);
  }
  if (moved) take_cuts();
  return moved;
}

template <class Arrays>
void Ordering::find_cells(Arrays& arrays, CellRanges& cells) {
  const Index n = arrays.local();
  key_.resize(n), order_.resize(n);
  launch(context_, "cell keys", n,
         PlaceKey{{grid_, {}}, arrays.place.span(), arrays.id.span(), key_.span(), order_.span()});
  cells.find(context_, grid_, key_.span(), n);
}

template <class Arrays>
void Ordering::deal_out(Arrays& arrays, CellRanges& cells, Index count, bool& dealt) {
  if (!ranks().several()) {
    arrays.resize(count);
    cells.find(context_, grid_, key_.span(), count);
    return;
  }
  Index own = count;
  std::uint64_t key = 0;
  const auto key_of = [&](Index row) {
    context_.copy_to_host(&key, key_.span().data + row, sizeof key);
    return key;
  };
  Index low = 0;  // the first that leaves
  while (low < own) {
    const Index middle = low + (own - low) / 2;
    key_of(middle) < leaving_key ? low = middle + 1 : own = middle;
  }
  if (dealt) {
    own = migrate(arrays, own, leaving_to(own, count - own));
    find_cells(arrays, cells);
    sort_keys(own);
    reorder(arrays, own);
  }
  arrays.resize(own);
  find_cells(arrays, cells);
  const Index stride = grid_.cells_of_plane();
  const int border = halo_planes < grid_.slab.own ? halo_planes : grid_.slab.own;
  const Borders borders{rows_before(context_, cells, border * stride),
                        own - rows_before(context_, cells, (grid_.slab.own - border) * stride)};
  arrays.resize(meet_neighbours(slabs_, own, borders));
  exchange_all(arrays);
  find_cells(arrays, cells);
  dealt = true;
}

std::vector<Index> Ordering::leaving_to(Index first, Index count) {
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(count));
  context_.copy_to_host(keys.data(), key_.span().data + first, keys.size() * sizeof(std::uint64_t));
  std::vector<Index> result(static_cast<std::size_t>(ranks().size()));
  for (const std::uint64_t key : keys) ++result[static_cast<std::size_t>(key >> 32 & 0x7fffffff)];
  return result;
}

template void Ordering::deal_out(FluidArrays&, CellRanges&, Index, bool&);
template void Ordering::deal_out(WallArrays&, CellRanges&, Index, bool&);
template void Ordering::find_cells(FluidArrays&, CellRanges&);

}  // namespace slagflow
