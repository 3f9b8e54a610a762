// A case: everything a case file says, in SI units, with the defaults filled in.
#pragma once

#include <array>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "fluid/models.hpp"
#include "fluid/setup.hpp"

namespace slagflow {

// One of +x -x +y -y +z -z.
struct Direction {
  int axis = 0;  // 0 x, 1 y, 2 z
  int sign = 1;  // +1 or -1
};

struct BoxSpec {
  Vec3d min, max;  // [m]
};
// The half-space on the side away from the normal.
struct PlaneSpec {
  Vec3d point;   // [m]
  Vec3d normal;  // any length but 0
};
struct CylinderSpec {
  Vec3d start, end;   // [m] ends of the axis
  double radius = 0;  // [m]
};
struct SphereSpec {
  Vec3d center;       // [m]
  double radius = 0;  // [m]
};
// A cone without its tip, or with it.
struct FrustumSpec {
  Vec3d start, end;                         // [m] ends of the axis
  double start_radius = 0, end_radius = 0;  // [m]
};
// A polygon, which may have dents, drawn out along an axis.
struct PrismSpec {
  int axis = 1;
  std::vector<std::array<double, 2>> points;  // [m] along the other two axes in the order x, y, z
  double from = 0, to = 0;                    // [m] along the axis
};
enum class PlateSide { back, front, middle };  // of a surface that gets a thickness

struct StlSpec {
  std::string file;      // absolute path
  double scale = 1;      // [m] per unit of the file
  Vec3d translate;       // [m], added after scaling
  double thickness = 0;  // [m] of a surface that encloses no volume; 0: it does
  PlateSide side = PlateSide::back;
};

struct ShapeSpec {
  using Form = std::variant<BoxSpec, PlaneSpec, CylinderSpec, SphereSpec, StlSpec, FrustumSpec, PrismSpec>;
  Form form;
  bool outside = false;  // everything outside of the form: a container
  // The form is moved, then turned about `center`.
  Vec3d move{};    // [m]
  Vec3d turn{};    // [rad] about the direction of the vector, by its length
  Vec3d center{};  // [m]
};

struct FluidSpec {
  std::string name;
  double density = 0;          // [kg/m^3]
  double surface_tension = 0;  // [N/m]
  RheologyKind rheology = RheologyKind::newtonian;
  // In the order of RheologyInfo::parameters; what heat sets is that of the hottest fluid of the start.
  std::array<double, most_parameters> parameters{};
  MaterialSetup material{};  // where heat is on

  const RheologyInfo& info() const { return rheologies[static_cast<std::size_t>(rheology)]; }
  Rheology law() const {
    Rheology law;
    law.kind = rheology;
    for (std::size_t k = 0; k < parameters.size(); ++k) law.parameters[k] = static_cast<Real>(parameters[k]);
    return law;
  }
};

enum class InitialPressure { hydrostatic, zero, uniform };

// A plane wave of velocity: amplitude sin(2 pi wave_vector.x + phase).
struct WaveSpec {
  Vec3d amplitude;    // [m/s]
  Vec3d wave_vector;  // [1/m], one over the wavelength
  double phase = 0;   // [rad]
};

// What a vessel holds when it is filled up to a level.
struct FillSpec {
  bool given = false;
  Vec3d level;  // [m] a point of the surface, which is square to gravity
  Vec3d from;   // [m] a point in the vessel below it
};

struct RegionSpec {
  int fluid = 0;                            // index into Case::fluids
  std::vector<ShapeSpec> shapes, subtract;  // without shapes it is filled
  FillSpec fill;
  Vec3d velocity;          // [m/s]
  Vec3d angular_velocity;  // [rad/s], about center
  Vec3d center;            // [m]
  std::vector<WaveSpec> waves;
  InitialPressure pressure = InitialPressure::hydrostatic;
  double uniform_pressure = 0;  // [Pa]
  double jitter = 0;            // [spacings] that particles start away from the lattice, along each axis
  double temperature = 0;       // [K] where heat is on
};

struct WallSpec {
  std::string name;
  WallSlip slip = WallSlip::no_slip;
  double slip_length = 0;     // [m], of partial slip
  double contact_angle = 90;  // [degrees]
  double tension_limit = -1;  // [Pa], up to that of [numerics]; < 0: that
  RigidVelocity surface{};    // of the material along the surface
  WallMotion motion{};
  WallThermal thermal{};
  std::vector<ShapeSpec> shapes, subtract;
};

enum class InletFace { rectangle, disc, annulus, stl };
enum class InletFeed { velocity, volume_flow, mass_flow };
enum class InletProfile { plug, developed };

// A face that fluid comes through.
struct InletSpec {
  std::string name;
  int fluid = 0;  // index into Case::fluids
  InletFace face = InletFace::rectangle;
  Vec3d center, normal;  // [m]; the way the fluid goes, of any length
  Vec3d up;              // along the height; 0: as much upwards as normal allows
  double width = 0, height = 0, radius = 0, inner_radius = 0;  // [m]
  StlSpec stl;
  InletFeed feed = InletFeed::velocity;
  double value = 0;                            // [m/s], [m^3/s] or [kg/s], where there are no rows
  std::vector<std::array<double, 2>> rows;     // [s] and the same
  double start = 0, stop = WallMotion::never;  // [s]
  InletProfile profile = InletProfile::plug;
  double temperature = 0;  // [K] where heat is on
};

enum class OutletShape { box, plane };

struct OutletSpec {
  std::string name;
  OutletShape shape = OutletShape::box;
  Vec3d min, max;       // [m] of a box
  Direction direction;  // of a plane: all beyond it this way
  double position = 0;  // [m] along the direction's axis
};

struct OutputSpec {
  double end_time = 0;          // [s], time steps are cut to meet it
  double until = 0;             // [s] the run ends with the first step at or after it; 0: at end_time
  double interval = 0;          // [s] between snapshots
  double history_interval = 0;  // [s] between lines of the history
  bool walls = true;            // write the wall particles
  // [s] of wall time between checkpoints; 0: only at the end and on signals
  double checkpoint_interval = 300;
  std::string stop_after;  // a front or jet that ends the run when it arrives; empty: none

  double last_time() const { return until > 0 ? until : end_time; }
};

enum class MeasureType {
  front,
  jet,
  flow_rate,
  volume,
  profile,
  force,
  level,
  flux,
  surface,
  contact,
  residence,
  mixing,
  solid,
  heat
};

struct MeasureSpec {
  std::string name;
  MeasureType type = MeasureType::front;
  double fraction = 0.002;       // front, jet: of all fluid particles that must have passed
  double solid_fraction = 0.5;   // solid: the least that counts
  Direction direction;           // front, flow_rate: the way it goes
  double position = 0;           // [m] front, flow_rate: the line or plane, along that axis
  Vec3d lip;                     // [m] jet: the dam's lip
  Direction outward;             // jet: horizontal, away from the wall
  double bottom = 0;             // [m] jet: coordinate along gravity's axis where the leading edge arrives
  Vec3d min, max;                // [m] volume, mixing, solid: the box
  double cell = 0;               // [m] mixing: side of a cell; 0: five spacings
  int fluid = 0;                 // mixing: index into Case::fluids
  Vec3d start, end;              // [m] profile, level, surface: the line
  int points = 50;               // profile, surface: on the line, both ends included
  Vec3d across;                  // [m] surface: from the first line to the last
  int rows = 1;                  // surface: lines
  int wall = 0;                  // force, contact, heat: index into Case::walls
  Vec3d about;                   // [m] force: the point of its torque
  Vec3d center, normal;          // [m] flux: of the rectangle
  Vec3d up;                      // flux: along its height; 0: as much upwards as normal allows
  double height = 0, width = 0;  // [m] flux
  int outlet = 0;                // residence: index into Case::outlets
};

struct Case {
  std::string file;  // the case file, as given
  std::string name, description;

  double spacing = 0;          // [m]
  double support_ratio = 2.6;  // support radius / spacing
  int dimensions = 3;
  Vec3d origin;  // [m], lattice sites at origin + (i + 1/2) spacing

  Vec3d gravity{0, 0, -9.81};  // [m/s^2]
  Vec3d body_force;            // [m/s^2]
  std::vector<FluidSpec> fluids;
  std::vector<RegionSpec> regions;
  std::vector<WallSpec> walls;
  std::vector<InletSpec> inlets;
  std::vector<OutletSpec> outlets;
  DomainSetup domain;
  std::array<bool, 6> exits{};  // faces -x +x -y +y -z +z that fluid is meant to leave through
  NumericsSetup numerics;       // sound_speed 0: automatic, see BuiltCase::resolved
  ThermalSetup thermal;
  LimitSetup limits;  // max_speed 0: automatic, see BuiltCase::resolved
  OutputSpec output;
  std::vector<MeasureSpec> measures;

  // Dotted key -> where it was given ("FILE:LINE" or "--set key=value"), for messages.
  std::map<std::string, std::string> places;

  // [s] from which on nothing moves: the end of the run, or thermal.flow_until before it.
  double flow_end() const {
    return thermal.on && thermal.flow_until < output.last_time() ? thermal.flow_until : output.last_time();
  }
  const char* what_ends_it() const {
    return flow_end() < output.last_time() ? "flow, thermal.flow_until," : "run";
  }

  // Where a key or, failing that, the table around it was given; the file if neither is known.
  std::string place_of(const std::string& key) const;
};

// Axis and sign of the largest component of gravity.
Direction down(const Case& c);

// Whether some fluid has a surface tension.
bool has_surface_tension(const Case& c);

// Reads and validates a case file. Each override is "dotted.key=value"; its value is TOML or else a bare
// string, and list entries are addressed by their index, as in "region.0.velocity=[1,0,0]".
// Throws InputError with one line for each thing that is wrong.
Case load_case(const std::string& path, const std::vector<std::string>& overrides = {});

// The same from text; `file` names it in messages, and STL files are looked for next to it.
Case parse_case(const std::string& text, const std::string& file,
                const std::vector<std::string>& overrides = {});

// The case as a TOML file with every key, defaults included. Loading it gives the same case.
std::string to_toml(const Case& c);

}  // namespace slagflow
