#include "host/run/run_changes.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "backend/error.hpp"
#include "host/case/case_changes.hpp"
#include "host/run/run_options.hpp"

namespace slagflow {
namespace {

const char* const changing_keys =
    "output.* but walls, limits.*, case.description, domain.exits, and of numerics courant, max_time_step, "
    "solver, "
    "solver_loop, weights, tolerance, max_iterations, relaxation and yield_iterations";

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

bool may_change(const std::string& key) {
  if (key == "output.walls") return false;
  if (begins(key, "output.") || begins(key, "limits.")) return true;
  for (const char* name :
       {"case.description", "domain.exits", "numerics.courant", "numerics.max_time_step", "numerics.solver",
        "numerics.solver_loop", "numerics.weights", "numerics.tolerance", "numerics.max_iterations",
        "numerics.relaxation", "numerics.yield_iterations"})
    if (key == name) return true;
  // Where an STL file lies; that the particles are the same is looked at.
  static const std::regex stl(R"((region|wall)\.\d+\.(shapes|subtract)\.\d+\.file)");
  return std::regex_match(key, stl);
}

std::string reason_to_stay(const std::string& key) {
  if (begins(key, "measure.")) return "history.csv has its columns from the start";
  if (key == "output.walls") return "walls.vtkhdf is there from the start or not at all";
  if (begins(key, "region.")) return "the fluid was there at the start";
  if (key == "case.name") return "the results carry it";
  return "the flow so far went by it";
}

std::string shown(const std::string& value) { return value.empty() ? "nothing" : value; }

// Throws InputError unless all may change.
void require_changing(const std::vector<KeyChange>& changes, const Case& c, const std::string& folder) {
  std::string lines, settings;
  for (const KeyChange& change : changes) {
    if (may_change(change.key)) continue;
    lines += c.place_of(change.key) + ": key '" + change.key + "': value " + shown(change.after) +
             ", the run has " + shown(change.before) + ": cannot change while it goes on, as " +
             reason_to_stay(change.key) + "\n";
    if (!change.after.empty()) settings += " --set " + as_assignment(change);
  }
  if (lines.empty()) return;
  throw InputError(lines + "allowed: " + changing_keys + "; for others slagflow run --from " +
                   shell_word(folder) + settings + " -o NEW, which begins a new run in this state");
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The case in the folder where someone has changed it, else that of the checkpoint.
Case case_with_changes(const FoundCheckpoint& found, const RunOptions& options, GoingCase& going) {
  const std::string path = options.folder + "/case.toml", &text = found.checkpoint.text("case_text");
  if (!std::filesystem::exists(path)) {
    going.messages.push_back(path + " was missing: it is written anew, from the checkpoint");
    return parse_case(text, found.path, options.changes);
  }
  if (text_of_file(path) == text) return parse_case(text, path, options.changes);
  try {
    return load_case(path, options.changes);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "\n" + path +
                     " is not the case of the run: without it the run goes on as it was");
  }
}

// Settings that say where the STL files of a case lie: those of the checkpoint may be gone.
std::vector<std::string> where_files_are(const Case& c) {
  std::vector<std::string> settings;
  const auto add = [&](const std::string& key, const StlSpec& stl) {
    settings.push_back(key + ".file=" + stl.file);
  };
  const auto add_shapes = [&](const std::string& key, const std::vector<ShapeSpec>& shapes) {
    for (std::size_t k = 0; k < shapes.size(); ++k)
      if (const auto* const stl = std::get_if<StlSpec>(&shapes[k].form))
        add(key + "." + std::to_string(k), *stl);
  };
  for (std::size_t k = 0; k < c.regions.size(); ++k) {
    add_shapes("region." + std::to_string(k) + ".shapes", c.regions[k].shapes);
    add_shapes("region." + std::to_string(k) + ".subtract", c.regions[k].subtract);
  }
  for (std::size_t k = 0; k < c.walls.size(); ++k) {
    add_shapes("wall." + std::to_string(k) + ".shapes", c.walls[k].shapes);
    add_shapes("wall." + std::to_string(k) + ".subtract", c.walls[k].subtract);
  }
  for (std::size_t k = 0; k < c.inlets.size(); ++k)
    if (c.inlets[k].face == InletFace::stl) add("inlet." + std::to_string(k), c.inlets[k].stl);
  return settings;
}

std::string moment(const RunRecord& run) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "at %.6g s, step %lld: ", run.time,
                static_cast<long long>(run.steps));
  return text.data();
}

}  // namespace

GoingCase going_case(const FoundCheckpoint& found, const RunOptions& options) {
  GoingCase going;
  Case c = case_with_changes(found, options, going);
  end_with_end_time(options.changes, c);
  if (options.until) end_at(*options.until, c);
  going.built = build_setup(c);
  const std::vector<KeyChange> changes = key_changes(
      parse_case(found.checkpoint.text("case_text"), found.path, where_files_are(c)), going.built.resolved);
  require_changing(changes, going.built.resolved, options.folder);
  for (const KeyChange& change : changes) {
    const std::string line = moment(found.checkpoint.run) + text_of(change);
    going.changes += (going.changes.empty() ? "" : "\n") + line;
    going.messages.push_back("changed " + line);
  }
  return going;
}

}  // namespace slagflow
