#include <array>
#include <cmath>
#include <cstdio>

#include "host/run/check.hpp"

namespace slagflow {
namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::string duration(double seconds) {
  if (seconds < 1) return "under a second";
  if (seconds < 120) return format("%.0f s", seconds);
  return seconds < 7200 ? format("%.0f min", seconds / 60) : format("%.1f h", seconds / 3600);
}

std::string number(double value) { return std::isnan(value) ? "-" : format("%.4g", value); }

// How many particles are across what.
std::string fineness_text(const CaseCheck& c) {
  std::string text;
  if (!c.pieces.empty())
    text += format("fluid            %zu piece%s at the start, %.3g particles across the thinnest\n",
                   c.pieces.size(), c.pieces.size() == 1 ? "" : "s that do not touch", c.fluid_across);
  if (c.wall.across < ThinnestWall::thick)
    text += format("walls            '%s' is thinnest, %.3g spacings at (%.4g, %.4g, %.4g) m\n",
                   c.wall.name.c_str(), c.wall.across, c.wall.place.x, c.wall.place.y, c.wall.place.z);
  else if (c.wall_particles > 0)
    text += format("walls            none thinner than %g spacings\n", ThinnestWall::thick);
  return text;
}

std::string time_text(const CaseCheck& c) {
  std::string text = "run time         roughly " + duration(c.run_time);
  if (c.machine.particle_steps > 0)
    text += format(" on this machine: %.2g particle-steps/s, measured %s%s\n", c.machine.particle_steps,
                   c.machine.made.c_str(), c.machine.now ? ", just now" : "; --calibrate measures anew");
  else
    text += format(" on two CPU cores (%.2g particle-steps/s); not measured on this machine\n",
                   particle_steps_per_second);
  text += "                 roughly " + duration(c.gpu_time) + " on an H100: a model figure, not measured\n";
  if (c.exact_yield)
    text += format(
        "                 times %g for the exact yield stress, whose cost no one knows before: 2 to 15\n",
        exact_yield_cost);
  return text;
}

}  // namespace

std::string to_text(const CaseCheck& c) {
  std::string text = "domain           " + c.extents + "\n";
  for (const std::string& file : c.files) text += "file             " + file + "\n";
  text += format("particles        %lld fluid, %lld wall\n", static_cast<long long>(c.fluid_particles),
                 static_cast<long long>(c.wall_particles));
  for (const std::string& inlet : c.inlets) text += inlet + "\n";
  text += fineness_text(c);
  text += format("spacing          %.4g m, support radius h %.4g m\n", c.spacing, c.support_radius);
  text += format("time step        %.4g s, limited by %s\n", c.time_step, c.time_step_reason.c_str());
  text += format("steps            %.0f to the end time\n", c.steps);
  text += format("scales           L %.4g m, H %.4g m, U %.4g m/s (%s)\n", c.width, c.depth, c.speed,
                 c.speed_source.c_str());
  for (const FluidNumbers& f : c.fluids)
    text += format("fluid %-10s Reynolds %s, Bingham %s, N %s%s\n", f.name.c_str(),
                   number(f.reynolds).c_str(), number(f.bingham).c_str(), number(f.dam).c_str(),
                   std::isnan(f.capillary) ? "" : (", capillary " + number(f.capillary)).c_str());
  text += "                 Froude " + number(c.froude) +
          " = U / sqrt(g H), Reynolds = rho U L / eta, Bingham = tau_B L / (eta U),\n"
          "                 N = rho L sqrt(g H) / eta, capillary = eta U / sigma\n";
  text += format("sound speed      %.4g m/s, Mach number %.3g\n", c.sound_speed, c.mach);
  for (const std::string& line : c.sound_speeds) text += "                 " + line + "\n";
  text += format("viscosity        corrected by %.4f for the bias of the operator at this support ratio\n",
                 c.viscosity_correction);
  text += to_text(c.heat);
  text += "exits            " + c.exits + "\n";
  text += format("memory           about %.3g MB\n", c.memory / 1e6);
  text += format("output           about %.3g MB in %.0f snapshots\n", c.output / 1e6, c.snapshots);
  text += time_text(c);
  for (const std::string& warning : c.warnings) text += "warning: " + warning + "\n";
  for (const std::string& line : c.advice) text += "advice: " + line + "\n";
  return text;
}

Json to_json(const CaseCheck& c) {
  const auto lines = [](const std::vector<std::string>& all) {
    Json::Array array;
    for (const std::string& line : all) array.emplace_back(line);
    return Json(std::move(array));
  };
  Json fluids = Json::object();
  for (const FluidNumbers& f : c.fluids)
    fluids.set(f.name, Json::object()
                           .set("reynolds", f.reynolds)
                           .set("bingham", f.bingham)
                           .set("n", f.dam)
                           .set("capillary", f.capillary));
  Json result = Json::object();
  result.set("fluid_particles", c.fluid_particles).set("wall_particles", c.wall_particles);
  result.set("fed_particles", c.fed).set("spacing", c.spacing).set("support_radius", c.support_radius);
  result.set("time_step", c.time_step).set("time_step_reason", c.time_step_reason).set("steps", c.steps);
  result.set("depth", c.depth).set("width", c.width).set("speed", c.speed);
  result.set("speed_source", c.speed_source).set("fluids", fluids);
  result.set("sound_speed", c.sound_speed)
      .set("mach", c.mach)
      .set("sound_speed_terms", lines(c.sound_speeds));
  result.set("viscosity_correction", c.viscosity_correction).set("exits", c.exits);
  result.set("inlets", lines(c.inlets)).set("memory_bytes", c.memory).set("run_time", c.run_time);
  result.set("froude", c.froude).set("pieces", c.pieces.size()).set("fluid_across", c.fluid_across);
  result.set("thinnest_wall", c.wall.name).set("wall_across", c.wall.across);
  result.set("domain", c.extents).set("files", lines(c.files));
  result.set("snapshots", c.snapshots).set("output_bytes", c.output);
  result.set("run_time_measured_on_this_machine", c.machine.particle_steps > 0);
  result.set("particle_steps_per_second",
             c.machine.particle_steps > 0 ? c.machine.particle_steps : particle_steps_per_second);
  result.set("measured_utc", c.machine.made).set("gpu_model_run_time", c.gpu_time);
  result.set("advice", lines(c.advice));
  if (c.heat.on) result.set("heat", to_json(c.heat));
  return result.set("exact_yield", c.exact_yield).set("warnings", lines(c.warnings));
}

}  // namespace slagflow
