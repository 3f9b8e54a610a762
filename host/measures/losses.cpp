#include "host/measures/losses.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>

namespace slagflow {
namespace {

constexpr double deep = 0.5;        // [spacings] in a wall
constexpr double tolerated = 1e-3;  // of all particles, lost without a warning
constexpr std::array<const char*, 6> face_names{"-x", "+x", "-y", "+y", "-z", "+z"};

std::string particles(std::int64_t count) {
  return std::to_string(count) + (count == 1 ? " particle" : " particles");
}

std::string number(const char* pattern, double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

std::string percent(std::int64_t count, std::int64_t start) {
  return number("%.3g %%", 100.0 * static_cast<double>(count) / static_cast<double>(start));
}

std::string departures(const Case& c, const Totals& totals, std::int64_t start) {
  const auto all = std::accumulate(totals.departed.begin(), totals.departed.end(), std::int64_t{0});
  if (all == 0) return "no particle left the domain";
  std::string text =
      particles(all) + " of " + std::to_string(start) + " (" + percent(all, start) + ") left the domain: ";
  const char* separator = "";
  for (std::size_t face = 0; face < face_names.size(); ++face) {
    if (totals.departed[face] == 0) continue;
    text += separator + std::to_string(totals.departed[face]) + " through " + face_names[face];
    text += c.exits[face] ? ", an exit" : ", no exit";
    separator = "; ";
  }
  return text;
}

}  // namespace

std::string exits_of(const Case& c) {
  std::string text;
  for (std::size_t face = 0; face < face_names.size(); ++face)
    if (c.exits[face]) text += (text.empty() ? "" : ", ") + std::string(face_names[face]);
  return text.empty() ? "none" : text;
}

Losses::Losses(const Case& c) : c_(c), depth_(c) {}

void Losses::look(Simulation& simulation) { look_at(simulation.below_wall_faces(), simulation.time()); }

void Losses::look_at_all(const Simulation& simulation) {
  if (!c_.walls.empty()) look_at(simulation.positions(), simulation.time());
}

void Losses::look_at(const std::vector<Vec3d>& places, double time) {
  depth_.move_to(time);
  in_walls_.now = 0;
  for (const Vec3d& place : places) {
    const double depth = depth_.of(place) / c_.spacing;
    in_walls_.deepest = std::max(in_walls_.deepest, depth);
    if (depth > deep) ++in_walls_.now;
  }
  in_walls_.most = std::max(in_walls_.most, in_walls_.now);
}

std::vector<std::string> Losses::lines(const Totals& totals, std::int64_t start) const {
  std::vector<std::string> lines{departures(c_, totals, start)};
  if (c_.walls.empty()) return lines;
  const std::string deepest = number("%.2f spacings", in_walls_.deepest);
  lines.push_back(in_walls_.most == 0
                      ? "no particle was deeper than half a spacing in a wall; the deepest " + deepest
                      : "deeper than half a spacing in walls: " + particles(in_walls_.most) + " at most, " +
                            std::to_string(in_walls_.now) + " at the end; the deepest " + deepest);
  return lines;
}

std::vector<std::string> Losses::warnings(const Totals& totals, std::int64_t start) const {
  std::vector<std::string> warnings;
  const double most = tolerated * static_cast<double>(start);
  for (std::size_t face = 0; face < face_names.size(); ++face) {
    const std::int64_t lost = totals.departed[face];
    if (!c_.exits[face] && static_cast<double>(lost) > most)
      warnings.push_back(particles(lost) + " (" + percent(lost, start) + ") left through face " +
                         face_names[face] +
                         " of the domain, which domain.exits does not name: if fluid is to leave there, name "
                         "it; else a wall leaks, or the domain is too small");
  }
  if (static_cast<double>(in_walls_.most) > most)
    warnings.push_back(particles(in_walls_.most) + " (" + percent(in_walls_.most, start) +
                       (in_walls_.most == 1 ? ") was" : ") were") +
                       " deeper than half a spacing in walls: the walls do not hold; try a larger "
                       "numerics.sound_speed, a smaller courant or thicker walls");
  return warnings;
}

void Losses::add_to(Json& summary, const Totals& totals) const {
  std::int64_t lost = 0;
  for (std::size_t face = 0; face < face_names.size(); ++face)
    if (!c_.exits[face]) lost += totals.departed[face];
  summary.set("exits", exits_of(c_)).set("lost_through_other_faces", lost);
  Json in_walls = Json::object();
  in_walls.set("most", in_walls_.most).set("at_end", in_walls_.now);
  summary.set("in_walls", in_walls.set("deepest_spacings", in_walls_.deepest));
}

}  // namespace slagflow
