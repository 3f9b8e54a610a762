// Decides which rows of the neighbour lists still hold all pairs. Falling fluid takes its neighbours along,
// so what counts is not how far a particle moved since its row was filled but how far it moved against those
// around it.
#pragma once

#include "backend/buffer.hpp"
#include "fluid/step_record.hpp"
#include "neighbours/cells.hpp"
#include "neighbours/list_gate.hpp"

namespace slagflow {

// Rows that no longer hold are filled anew, or, once any does not, all lists are built anew.
enum class Renewal { by_cell, of_all };

// With D_C the mean displacement in a step in a cell C and e_C the largest deviation from it, two particles
// in cells C, C' approach each other by at most |D_C - D_C'| + e_C + e_C'. A cell's wear is the sum over the
// steps of the largest of these over the cells that are at most two apart, in skins, the walls having a D and
// e of their own. Its rows hold while it is at most one, and while no particle moved farther than
// width - h/2 since all were sorted into cells, which keeps particles in cells further apart out of reach.
class ListAge {
 public:
  ListAge(Context&, Renewal);

  struct Particles {
    SourceView now;                   // as they were sorted
    double largest_displacement = 0;  // of any of them since [m]; 0: all are at rest
    Span<const std::uint8_t> beside;  // cells that may have some of the other kind near; each cell
    const Halo* halo = nullptr;       // where other ranks have the rest of them
  };

  // All lists have just been built.
  void begin(const SourceView& fluid, const SourceView& walls);

  // At the end of a step, without waiting: adds what it wore and marks the cells whose rows must be filled
  // anew. Idle where the record's displacement alone decides. Leaves in record->worn what exceeds the skin
  // when all lists must be built anew.
  void launch_look(const Particles& fluid, const Particles& walls, const ListReach&, StepRecord*);
  // The same at once, for walls that move as well. Whether a look was needed.
  bool look(const Particles& fluid, const Particles& walls, const ListReach&, StepRecord*);
  ListGate gate(const ListReach& reach, const StepRecord* record) const {
    return {record, opened_.span().data, reach};
  }

  // Of the rank's own cells, with fluid and with walls.
  Span<const std::uint8_t> worn() const { return {worn_.span().data, own_cells_}; }
  Span<const std::uint8_t> walls_worn() const { return {walls_worn_.span().data, own_cells_}; }
  bool opened() const;

  template <class Visitor>
  void save(Visitor& v) {
    v.as_many("list_opened", opened_), v.of_cells("list_wear", wear_),
        v.of_cells("wall_list_wear", wall_wear_);
  }
  // After save(): the places of the last look, those of now unless there was none.
  void restore(const SourceView& fluid, const SourceView& walls);

 private:
  void launch(const Particles& fluid, const Particles& walls, const ListGate&, StepRecord*);

  Context& context_;
  Renewal renewal_;
  Buffer<Quad> before_, walls_before_;  // places at the last look
  // Of each cell: xyz mean, w largest deviation, negative in an empty cell.
  Buffer<Quad> displacement_, wall_displacement_;
  Buffer<Real> wear_, wall_wear_;  // of each cell, in skins
  Buffer<std::uint8_t> worn_, walls_worn_;
  Index own_cells_ = 0;
  Buffer<Index> opened_;  // one: whether there was a look since begin()
};

}  // namespace slagflow
