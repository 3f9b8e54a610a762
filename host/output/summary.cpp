#include "host/output/summary.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

namespace slagflow {
namespace {

const char* solver_name(ViscousSolver solver) {
  switch (solver) {
    case ViscousSolver::sor:
      return "sor";
    case ViscousSolver::jacobi:
      return "jacobi";
    case ViscousSolver::conjugate_gradient:
      return "conjugate_gradient";
    default:
      return "multigrid";
  }
}

std::int64_t peak_memory() {  // [bytes]
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{1024} * usage.ru_maxrss;
}

Json viscous_of(const Json& solver, const SolverTotals& totals) {
  const auto steps = static_cast<double>(std::max<std::int64_t>(totals.steps, 1));
  Json viscous = Json::object();
  viscous.set("solver", solver)
      .set("iterations_mean", static_cast<double>(totals.iterations) / steps)
      .set("iterations_max", totals.max_iterations)
      .set("worst_residual", totals.worst_residual)
      .set("retried_steps", totals.retried);
  if (totals.yield_iterations > 0)
    viscous.set("yield_iterations_mean", static_cast<double>(totals.yield_iterations) / steps)
        .set("yield_unconverged_solves", totals.yield_unconverged);
  return viscous;
}

Json departed_of(const Totals& totals) {
  constexpr std::array<const char*, 6> faces{"-x", "+x", "-y", "+y", "-z", "+z"};
  Json departed = Json::object();
  for (std::size_t k = 0; k < faces.size(); ++k) departed.set(faces[k], totals.departed[k]);
  return departed;
}

Json lines_of(const std::string& text) {
  Json::Array lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.emplace_back(line);
  return Json(std::move(lines));
}

// Where the run began, if in the state of another one.
Json origin_of(const Provenance& provenance) {
  Json origin = Json::object();
  for (const auto& [name, value] : provenance.origin) {
    const std::string key = name.substr(name.find('_') + 1);
    if (key == "time" || key == "step")
      origin.set(key, std::stod(value));
    else
      origin.set(key, key == "changes" ? lines_of(value) : Json(value));
  }
  return origin;
}

void add_cost(Json& summary, const Simulation& simulation, const RunCounts& counts) {
  const double wall = std::max(counts.wall_time, 1e-9);
  summary.set("wall_time", counts.wall_time).set("setup_time", counts.setup_time);
  summary.set("particle_steps_per_second", static_cast<double>(counts.particle_steps) / wall);
  const std::size_t bytes = simulation.device_bytes();
  const auto particles = static_cast<double>(std::max<std::int64_t>(counts.particles_start, 1));
  summary.set("peak_memory_bytes", peak_memory()).set("device_bytes", bytes);
  const DeviceCounts device = simulation.device_counts();
  summary.set("device_waits", device.waits).set("device_launches", device.launches);
  summary.set("device_graph_launches", device.graph_launches);
  summary.set("device_graph_kernels", device.graph_kernels);
  summary.set("device_graph_recordings", device.graph_recordings);
  summary.set("device_bytes_per_particle", static_cast<double>(bytes) / particles);
  Json timings = Json::object();
  for (const auto& [part, seconds] : simulation.timings()) timings.set(part, seconds);
  summary.set("timings", timings);
}

}  // namespace

Json summary_of_case(const Case& resolved, const Provenance& provenance, const RunCounts& counts) {
  Json summary = Json::object();
  summary.set("case", resolved.name).set("status", Json()).set("version", provenance.version);
  summary.set("commit", provenance.commit).set("compiler", provenance.compiler);
  summary.set("build_type", provenance.build_type).set("backend", provenance.backend);
  summary.set("device", provenance.device).set("threads", provenance.threads);
  summary.set("precision", provenance.precision).set("started_utc", provenance.started_utc);
  if (!provenance.origin.empty()) summary.set("from", origin_of(provenance));
  if (!provenance.changes.empty()) summary.set("changes", lines_of(provenance.changes));
  summary.set("particles", Json::object().set("fluid", counts.particles_start).set("wall", counts.walls));
  summary.set("spacing", resolved.spacing).set("support_radius", resolved.support_ratio * resolved.spacing);
  summary.set("dimensions", resolved.dimensions).set("sound_speed", resolved.numerics.sound_speed);
  summary.set("viscous", Json::object().set("solver", solver_name(resolved.numerics.solver)));
  return summary;
}

std::string compression_line(const PeakCompression& largest) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "largest compression %.3g %% at %.4g s", 100 * largest.value,
                largest.time);
  return text.data();
}

void add_results(Json& summary, const Simulation& simulation, const Totals& totals, const RunCounts& counts) {
  summary.set("steps", simulation.steps()).set("simulated_time", simulation.time());
  summary.set("time_step", simulation.time_step());
  const Json solver = summary.at("viscous").at("solver");
  summary.set("viscous", viscous_of(solver, simulation.solver_totals()));
  summary.set("neighbours_mean", simulation.neighbours_mean()).set("list_builds", simulation.list_builds());
  summary.set("mass_start", totals.mass_start).set("mass_in", totals.mass_in);
  summary.set("mass_left", totals.mass_left).set("departed", departed_of(totals));
  summary.set("particles_in", totals.particles);
  const PeakCompression compression = simulation.largest_compression();
  summary.set("max_compression", compression.value).set("max_compression_time", compression.time);
  summary.set("kinetic_energy", totals.kinetic_energy).set("potential_energy", totals.potential_energy);
  summary.set("dissipated_energy", totals.dissipated_energy).set("max_speed", totals.max_speed);
  add_cost(summary, simulation, counts);
}

}  // namespace slagflow
