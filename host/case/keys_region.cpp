// [[region]]: where fluid is at the start.
#include "host/case/case_keys.hpp"
#include "host/case/keys_thermal.hpp"

namespace slagflow {
namespace {

const Words pressure_names{"hydrostatic", "zero"};

void describe_wave(CaseVisitor& v, WaveSpec& wave) {
  v.vector(required("amplitude", "a in a sin(2π k·x + phase)"), wave.amplitude, any_number("m/s"));
  v.vector(required("wave_vector", "k, one over the wavelength"), wave.wave_vector, any_number("1/m"));
  v.number(key("phase", "of the sine"), wave.phase, any_number("rad"));
}

// A resolved case tells of it where there is one.
void describe_fill(CaseVisitor& v, RegionSpec& region) {
  if (!region.fill.given && !v.takes_defaults()) return;
  const bool given = v.given({"fill"});
  v.inline_table(key("fill",
                     "in place of shapes: all that a pour would fill up to a level, between walls and under "
                     "earlier regions")
                     .by_default("none"),
                 [&] {
                   v.vector(required("level", "a point of the surface, which is square to gravity"),
                            region.fill.level, any_number("m"));
                   v.vector(required("from", "a point below it, in the vessel"), region.fill.from,
                            any_number("m"));
                 });
  region.fill.given = region.fill.given || given;
}

void describe_region(CaseVisitor& v, const Case& c, RegionSpec& region) {
  describe_fluid_of(v, c, region.fluid);
  describe_fill(v, region);
  Key shapes = key("shapes", "the region is their union, less that of subtract; see Shapes")
                   .by_default("required without fill");
  if (!region.fill.given) shapes.need = Need::required;
  if (!region.fill.given || v.takes_defaults()) describe_shapes(v, shapes, region.shapes, c.file);
  if (region.fill.given && !region.shapes.empty())
    v.problem("fill", "stands beside shapes: allowed: one of them");
  describe_shapes(v, key("subtract", "what is taken away"), region.subtract, c.file);
  describe_start_temperature(v, c, required("temperature", "at the start"), region.temperature);
  v.vector(key("velocity", "at the start"), region.velocity, any_number("m/s"));
  v.vector(key("angular_velocity", "rigid rotation about center, added to velocity"), region.angular_velocity,
           any_number("rad/s"));
  v.vector(key("center", "of angular_velocity"), region.center, any_number("m"));
  v.list(key("waves", "plane waves of velocity, added to it. Two of them make Taylor and Green's vortices"),
         region.waves, [&](WaveSpec& wave) { describe_wave(v, wave); });
  int pressure = static_cast<int>(region.pressure);
  v.choice_or_number(key("pressure",
                         "hydrostatic: the weight of all fluid above, see Pressure at the start; a number: "
                         "the same everywhere, for flows without a free surface"),
                     pressure, pressure_names, region.uniform_pressure, at_least(0, "Pa"));
  region.pressure = static_cast<InitialPressure>(pressure);
  v.number(
      key("jitter",
          "particles start evenly spread within this distance of their lattice site along each axis, the "
          "same in every run. They settle, and the fluid loses 0.6 jitter², up to 0.12 jitter, of its "
          "density "
          "(lucy: 0.4 jitter²; with shifting = 1 0.4 of that): a closed space as much of ρc₀² in pressure, "
          "with a warning; under a free surface it sinks by that share"),
      region.jitter, between(0, 0.5, "spacings"));
}

}  // namespace

void describe_regions(CaseVisitor& v, Case& c) {
  v.list(key("region", "where fluid is at the start; without an inlet one or more"), c.regions,
         [&](RegionSpec& region) { describe_region(v, c, region); });
}

}  // namespace slagflow
