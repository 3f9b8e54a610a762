#include "host/measures/profiles.hpp"

#include "backend/error.hpp"
#include "host/measures/measure_text.hpp"
#include "host/output/checkpoint_store.hpp"

namespace slagflow {
namespace {

std::vector<std::string> profile_columns() {
  return {"time_s",         "distance_m",     "x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s",
          "shear_rate_1_s", "viscosity_Pa_s", "fill"};
}

std::vector<std::string> paths_of(const Case& c, const std::string& folder) {
  std::vector<std::string> paths;
  for (const MeasureSpec& m : c.measures)
    if (m.type == MeasureType::profile) paths.push_back(folder + "/" + profile_file(m.name));
  return paths;
}

}  // namespace

Json ProfileMeasure::summary() const {
  return Json::object().set("type", type()).set("points", line_.points).set("file", profile_file(name()));
}

std::string ProfileMeasure::line() const {
  return format("%.0f points, in ", line_.points) + profile_file(name());
}

std::string profile_file(const std::string& name) { return "profile_" + name + ".csv"; }

ProfileFiles::ProfileFiles(const Case& c, const std::string& folder) {
  for (const std::string& path : paths_of(c, folder)) files_.emplace_back(path, profile_columns());
}

ProfileFiles::ProfileFiles(const Case& c, const std::string& folder, const std::vector<std::int64_t>& ends) {
  const std::vector<std::string> paths = paths_of(c, folder);
  if (ends.size() != 2 * paths.size())
    throw Error("checkpoint: " + std::to_string(ends.size()) + " numbers for " +
                std::to_string(paths.size()) + " profiles");
  for (std::size_t k = 0; k < paths.size(); ++k)
    files_.emplace_back(paths[k], profile_columns(), HistoryEnd{ends[2 * k], ends[2 * k + 1]});
}

void ProfileFiles::write(const Simulation& simulation) {
  for (std::size_t k = 0; k < files_.size(); ++k)
    for (const ProfilePoint& p : simulation.profile(k))
      files_[k].write({simulation.time(), p.distance, p.position.x, p.position.y, p.position.z, p.velocity.x,
                       p.velocity.y, p.velocity.z, p.shear_rate, p.viscosity, p.fill});
}

std::vector<std::int64_t> ProfileFiles::finish() {
  std::vector<std::int64_t> ends;
  for (const HistoryFile& file : files_) {
    flush_to_disk(file.path());
    ends.push_back(file.end().lines);
    ends.push_back(file.end().bytes);
  }
  return ends;
}

}  // namespace slagflow
