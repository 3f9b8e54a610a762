// Brings fluid in through inlets.
#pragma once

#include <vector>

#include "fluid/params.hpp"
#include "fluid/particles.hpp"
#include "fluid/setup.hpp"
#include "walls/moving_walls.hpp"

namespace slagflow {

// What comes in at once.
struct FedParticles {
  std::vector<Vec3d> position;      // [m] from the domain's lower corner
  std::vector<std::uint8_t> fluid;  // index
  std::vector<Quad> motion;         // m/s
  std::vector<Index> column;
  std::vector<std::size_t> inlet;
};

class Inlets {
 public:
  explicit Inlets(Context&);

  // The wall particles of inlets are the last of the setup's, column by column, the foremost first;
  // inlet_rows() of them to a column. Their state at the setup's start time.
  void upload(const SimulationSetup&);

  bool any() const { return !inlets_.empty(); }

  // Puts the columns where they are: as far as the fluid has come, less the rows that have entered. The same
  // moments as MovingWalls::place, after it.
  void place(const WallStep&, WallArrays&);

  // Before the lists are built: what has come in by `now` is appended to the fluid with the pressure of the
  // wall particle that it was. Ids go on from `next_id`, by inlet, then by column. The walls are to be placed
  // anew.
  struct Feeding {
    double now, last_dt;  // [s]
    Index next_id;
  };
  FedParticles feed(const Feeding&, const WallArrays&, Span<const FluidConstants>, const FlowConstants&,
                    FluidArrays&);
  // Whether rows of a quarter of the columns are due, or one by half a stride: the lists are to be built.
  bool overdue(double now) const;
  // As if fed at that time, without any fluid: for a restored state, whose lists were built then.
  void fed_at(double time);

  // Particles since the start: of each inlet, and of all.
  std::vector<std::int64_t> fed() const;
  std::int64_t all_fed() const;

  bool is_column(std::size_t wall_particle) const { return wall_particle >= first_wall_; }
  // [m] of a wall particle at a time, when the lists were built at another.
  Vec3d position_at(std::size_t wall_particle, double time, double list_time) const;

  // Bounds over all columns, as of MovingWalls.
  double largest_displacement(double from, double to) const;
  double largest_speed() const { return speed_; }  // [m/s] as of the last place()

  // Of an inlet now, in its mean speed; a column has its share of all but the normal and the stride.
  struct Moment {
    Vec3d normal;
    double stride = 0;            // [m]
    double travelled = 0;         // [m] until now
    double gain = 0, gained = 0;  // [m] in this step and in the last
    double acceleration = 0;      // [m/s^2] in the middle of this one
  };

 private:
  struct Column {
    std::size_t inlet;
    Vec3d origin;  // [m] from the domain's lower corner
    double share;
    std::int64_t rows, rows_at_start;  // that have entered
  };
  // Whole rows that have entered by then.
  std::int64_t rows_by(const Column&, double time) const;
  // The rows that are due by then, which count as entered.
  FedParticles take_rows(double now, double last_dt);
  void upload_rows();
  void take_pressures(const WallArrays&);

  Context& context_;
  std::vector<InletSetup> inlets_;
  std::vector<Column> columns_;
  Vec3d lower_;                            // [m] corner of the domain
  std::size_t first_wall_ = 0, rows_ = 1;  // to a column
  int moving_rows_ = 1;
  double speed_ = 0;
  std::vector<double> largest_share_;  // of each inlet
  Buffer<Moment> moment_;              // of each inlet
  // Of each column:
  Buffer<Vec3d> origin_;
  Buffer<double> share_, retreat_;
  Buffer<std::uint8_t> inlet_;
  Buffer<Real> pressure_;
  // Of particles that come in:
  Buffer<Vec3d> position_;
  Buffer<Quad> motion_;
  Buffer<Index> column_;
  Buffer<std::uint8_t> kind_;
};

}  // namespace slagflow
