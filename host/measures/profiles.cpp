#include "host/measures/profiles.hpp"

#include "backend/error.hpp"
#include "backend/ranks.hpp"
#include "host/measures/measure_surface.hpp"
#include "host/measures/measure_text.hpp"
#include "host/output/checkpoint_store.hpp"

namespace slagflow {
namespace {

std::vector<std::string> profile_columns(bool heat) {
  std::vector<std::string> columns{
      "time_s",         "distance_m",     "x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s",
      "shear_rate_1_s", "viscosity_Pa_s", "fill"};
  if (heat) columns.insert(columns.end(), {"temperature_K", "solid_fraction"});
  return columns;
}

std::vector<std::string> columns_of(MeasureType type, bool heat) {
  return type == MeasureType::profile ? profile_columns(heat) : surface_columns();
}

std::vector<double> profile_line(double time, const ProfilePoint& p, bool heat) {
  std::vector<double> line{time,         p.distance,   p.position.x, p.position.y, p.position.z, p.velocity.x,
                           p.velocity.y, p.velocity.z, p.shear_rate, p.viscosity,  p.fill};
  if (heat) line.insert(line.end(), {p.temperature, p.solid_fraction});
  return line;
}

}  // namespace

std::vector<MeasureFile> measure_files(const Case& c) {
  std::vector<MeasureFile> files;
  for (const MeasureType type : {MeasureType::profile, MeasureType::surface})
    for (const MeasureSpec& m : c.measures)
      if (m.type == type)
        files.push_back({type, type == MeasureType::profile ? profile_file(m.name) : surface_file(m.name)});
  return files;
}

Json ProfileMeasure::summary() const {
  return Json::object().set("type", type()).set("points", line_.points).set("file", profile_file(name()));
}

std::string ProfileMeasure::line() const {
  return format("%.0f points, in ", line_.points) + profile_file(name());
}

std::string profile_file(const std::string& name) { return "profile_" + name + ".csv"; }

ProfileFiles::ProfileFiles(const Case& c, const SimulationSetup& setup, const std::string& folder)
    : surfaces_(setup.surfaces), heat_(setup.thermal.on) {
  const std::vector<MeasureFile> files = measure_files(c);
  profiles_ = files.size() - surfaces_.size();
  if (!ranks().first()) return;
  for (const MeasureFile& file : files)
    files_.emplace_back(folder + "/" + file.name, columns_of(file.type, heat_));
}

ProfileFiles::ProfileFiles(const Case& c, const SimulationSetup& setup, const std::string& folder,
                           const std::vector<std::int64_t>& ends)
    : surfaces_(setup.surfaces), heat_(setup.thermal.on) {
  const std::vector<MeasureFile> files = measure_files(c);
  if (ends.size() != 2 * files.size())
    throw Error("checkpoint: " + std::to_string(ends.size()) + " numbers for " +
                std::to_string(files.size()) + " profiles");
  profiles_ = files.size() - surfaces_.size();
  if (!ranks().first()) return;
  for (std::size_t k = 0; k < files.size(); ++k)
    files_.emplace_back(folder + "/" + files[k].name, columns_of(files[k].type, heat_),
                        HistoryEnd{ends[2 * k], ends[2 * k + 1]});
}

ProfileFiles::Lines ProfileFiles::read(const Simulation& simulation) const {
  const double time = simulation.time();
  Lines lines(profiles_);
  for (std::size_t k = 0; k < profiles_; ++k)
    for (const ProfilePoint& p : simulation.profile(k)) lines[k].push_back(profile_line(time, p, heat_));
  for (std::size_t k = 0; k < surfaces_.size(); ++k)
    lines.push_back(surface_lines(time, surfaces_[k], simulation.surface(k)));
  return lines;
}

void ProfileFiles::write(const Lines& lines) {
  for (std::size_t k = 0; k < files_.size(); ++k)
    for (const std::vector<double>& line : lines[k]) files_[k].write(line);
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
