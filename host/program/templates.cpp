// The cases that `slagflow init` writes. @NAME@, @SPACING@ and @FLUID@ are filled in.
#include "host/program/init.hpp"

namespace slagflow {
namespace {

const char* const dam = R"(# Slag runs out of a channel over a lip, and falls. Lengths in m, all in SI units.
# What a key means: slagflow help KEY. Before it runs: slagflow check @NAME@.toml
[case]
name = "@NAME@"
description = "A dam is gone at once, and slag runs over a lip"

[resolution]
spacing = @SPACING@            # finer is slower: half of it takes 16 times as long
origin = [0, -0.025, 0]        # walls a whole number of spacings from here

[fluid.slag]
@FLUID@

[[region]]                     # where fluid is at the start
shapes = [{shape="box", min=[-0.1, -0.025, 0], max=[0, 0.025, 0.02]}]

[[wall]]                       # three spacings thick at least
name = "channel"
shapes = [
  {shape="box", min=[-0.15, -0.08, -0.2], max=[0, 0.08, 0]},       # floor, and the face below the lip
  {shape="box", min=[-0.15, 0.025, 0], max=[0, 0.08, 0.03]},       # side walls
  {shape="box", min=[-0.15, -0.08, 0], max=[0, -0.025, 0.03]},
  {shape="box", min=[-0.15, -0.08, 0], max=[-0.1, 0.08, 0.03]},    # back wall
]

[domain]                       # what leaves it is removed
min = [-0.11, -0.045, -0.155]
max = [0.15, 0.045, 0.03]
exits = ["-z"]                 # where it is meant to leave

[output]
end_time = 0.4
interval = 0.01                # between snapshots
history_interval = 0.001       # between lines of history.csv

[[measure]]
name = "jet"                   # when it arrives 145 mm below, and whether as a jet
type = "jet"
lip = [0, 0, 0]
outward = "+x"
bottom = -0.145

[[measure]]
name = "lip"                   # what passes the lip
type = "flux"
center = [0, 0, 0.015]
normal = [1, 0, 0]
height = 0.03
width = 0.05
)";

const char* const runner =
    R"(# A runner that is fed, in two dimensions: per metre of width. Does it run over? Lengths in m, all in SI units.
# What a key means: slagflow help KEY. Before it runs: slagflow check @NAME@.toml
[case]
name = "@NAME@"
description = "Slag is fed into a runner and falls off its end"

[resolution]
spacing = @SPACING@            # finer is slower: half of it takes 8 times as long
dimensions = 2                 # the plane y = 0; shapes hold it, from y = -1 to 1

[gravity]
acceleration = [0.171, 0, -9.8085]   # a slope of one degree

[fluid.slag]
@FLUID@

[[wall]]
name = "runner"
shapes = [{shape="box", min=[-0.1, -1, -0.1], max=[1.5, 1, 0]},    # floor
          {shape="box", min=[-0.1, -1, 0], max=[0, 1, 0.2]}]       # end wall, which the inlet opens

[[inlet]]
name = "tap"
face = "rectangle"
center = [0, 0, 0.04]
height = 0.08
normal = [1, 0, 0]             # the way the fluid goes
volume_flow = [[0, 0], [0.5, 0.015]]   # [s], [m^3/s] a metre of width: within half a second

[[outlet]]
name = "ladle"                 # takes what falls off the end
shape = "plane"
direction = "-z"
position = -0.14

[domain]
min = [-0.1, -1, -0.2]
max = [1.9, 1, 0.3]

[output]
end_time = 6
interval = 0.2

[[measure]]
name = "height"                # over the floor in the middle; the most is told at the end
type = "level"
start = [0.7, 0, 0]
end = [0.7, 0, 0.2]

[[measure]]
name = "surface"               # along the runner: surface_surface.csv
type = "surface"
start = [0.05, 0, 0]
end = [1.45, 0, 0]
points = 29

[[measure]]
name = "end"                   # what runs off its end, and back
type = "flux"
center = [1.45, 0, 0.1]
normal = [1, 0, 0]
height = 0.2

[[measure]]
name = "stay"                  # how long the slag was in the runner
type = "residence"
outlet = "ladle"
)";

const char* const pouring =
    R"(# A vessel tilts about its lip and pours, in two dimensions: per metre of width. Lengths in m, all in SI units.
# What a key means: slagflow help KEY. Before it runs: slagflow check @NAME@.toml
[case]
name = "@NAME@"
description = "A vessel tilts about its lip and pours slag"

[resolution]
spacing = @SPACING@            # finer is slower: half of it takes 8 times as long
dimensions = 2                 # the plane y = 0; shapes hold it, from y = -1 to 1

[fluid.slag]
@FLUID@

[[region]]                     # filled up to a level, whatever the vessel's form
fill = {level=[0, 0, 0.12], from=[-0.1, 0, 0.05]}

[[wall]]
name = "vessel"
shapes = [{shape="box", min=[-0.24, -1, -0.04], max=[0.04, 1, 0.16]}]
subtract = [{shape="box", min=[-0.2, -1, 0], max=[0, 1, 1]}]
# Times [s] and angles [rad] about the lip; or file = "tilt.csv" with time_s, angle_deg
motion = {type="table", time=[0, 3], angle=[0, 1.4], axis=[0, 1, 0], center=[0.04, 0, 0.16], interpolation="smooth"}

[domain]                       # holds the vessel on all its way, and the stream
min = [-0.3, -1, -0.3]
max = [0.4, 1, 0.5]
exits = ["-z"]

[output]
end_time = 4
interval = 0.1

[[measure]]
name = "poured"                # what falls past z = -0.2
type = "flux"
center = [0.1, 0, -0.2]
normal = [0, 0, -1]
height = 0.58

[[measure]]
name = "drive"                 # force, and torque about the lip
type = "force"
wall = "vessel"
about = [0.04, 0, 0.16]

[[measure]]
name = "lining"                # share of the wall that is wetted, the largest pressure and where
type = "contact"
wall = "vessel"
)";

const char* const slump =
    R"(# A column of a fluid with a yield stress slumps to a film that stands, in two dimensions. Lengths in m, SI units.
# What a key means: slagflow help KEY. Before it runs: slagflow check @NAME@.toml
[case]
name = "@NAME@"
description = "A column slumps until its yield stress holds it"

[resolution]
spacing = @SPACING@            # finer is slower: half of it takes 8 times as long
dimensions = 2                 # the plane y = 0; shapes hold it, from y = -1 to 1

[fluid.slag]
@FLUID@

[[region]]                     # half of it: a wall without friction stands for the other half
shapes = [{shape="box", min=[0, -1, 0], max=[0.1, 1, 0.1]}]

[[wall]]
name = "floor"
shapes = [{shape="box", min=[-0.1, -1, -0.1], max=[0.8, 1, 0]}]

[[wall]]
name = "middle"
slip = "free_slip"
shapes = [{shape="box", min=[-0.1, -1, 0], max=[0, 1, 0.3]}]

[domain]
min = [-0.03, -1, -0.03]
max = [0.6, 1, 0.15]

[output]
end_time = 1
interval = 0.02

[[measure]]
name = "run_out"               # how far it has come
type = "front"
direction = "+x"
position = 0.2
fraction = 0.01

[[measure]]
name = "film"                  # its shape: surface_film.csv
type = "surface"
start = [0.005, 0, 0]
end = [0.495, 0, 0]
points = 50
)";

const char* const viscometer =
    R"(# Concentric cylinders, in two dimensions: a viscometer a metre long. Lengths in m, all in SI units.
# What a key means: slagflow help KEY. Before it runs: slagflow check @NAME@.toml
# A Newtonian fluid turns the bob with 4 pi eta Omega R1^2 R2^2/(R2^2 - R1^2) a metre, 8.38e-3 N m for each Pa s here.
[case]
name = "@NAME@"
description = "A bob turns in a cup; its torque tells the viscosity"

[resolution]
spacing = @SPACING@            # ten across the gap at least; finer is slower: half of it takes 8 times as long
dimensions = 2                 # the plane y = 0; shapes hold it, from y = -1 to 1

[gravity]
acceleration = [0, 0, 0]

[fluid.slag]
@FLUID@

[[region]]
shapes = [{shape="cylinder", start=[0, -1, 0], end=[0, 1, 0], radius=0.02}]
subtract = [{shape="cylinder", start=[0, -1, 0], end=[0, 1, 0], radius=0.01}]
pressure = "zero"

[[wall]]
name = "bob"
surface_angular_velocity = [0, 5, 0]   # [rad/s]
shapes = [{shape="cylinder", start=[0, -1, 0], end=[0, 1, 0], radius=0.01}]

[[wall]]
name = "cup"
shapes = [{shape="cylinder", start=[0, -1, 0], end=[0, 1, 0], radius=0.02, outside=true}]

[domain]
min = [-0.024, -0.001, -0.024]
max = [0.024, 0.001, 0.024]
departure = "stop"             # nothing may leave

[numerics]
sound_speed = 0.5              # ten times the speed of the bob
tension = "limit"              # no free surface
tension_limit = 1e4

[output]
end_time = 0.3
interval = 0.01

[[measure]]
name = "bob"                   # torque about its axis, a metre
type = "force"
wall = "bob"

[[measure]]
name = "gap"                   # velocity, shear rate and viscosity across it
type = "profile"
start = [0.01, 0, 0]
end = [0.02, 0, 0]
points = 21
)";

}  // namespace

const std::vector<CaseTemplate>& case_templates() {
  static const std::vector<CaseTemplate> all{
      {"dam", "slag runs over a lip and falls", {2600, 1, 5, 0.0025}, dam},
      {"runner", "a runner that an inlet feeds", {2700, 1, 3, 0.01}, runner},
      {"pouring", "a vessel tilts and pours", {2600, 2, 2, 0.005}, pouring},
      {"slump", "a column slumps to a film", {2000, 1, 100, 0.0025}, slump},
      {"viscometer", "a bob turns in a cup", {2600, 0.5, 0, 0.0005}, viscometer}};
  return all;
}

}  // namespace slagflow
