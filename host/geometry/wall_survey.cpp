#include "host/geometry/wall_survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace slagflow {
namespace {

constexpr double least_thickness = 3;  // [spacings]
constexpr double rounding = 0.05;      // [spacings] that a wall may be thinner
constexpr double stride = 0.05;        // [spacings] at least, of the search for the other side
constexpr double touch = 1e-3;         // [spacings]: parts of walls as near as that are one
constexpr double opposite = -0.5;      // cosine between faces, from which on they are two sides of a plate
constexpr double step_width = 1.8;     // [spacings] to either side: steps less than two wide show both ends
constexpr std::size_t half_turn = 8;   // directions that steps are looked for in
constexpr double pi = 3.14159265358979323846;
constexpr double step_height = 0.4;  // [spacings]
constexpr int looks = 24;            // at a wall on its way

std::string place(Vec3d p) {
  char text[100];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) m", p.x, p.y, p.z);
  return text;
}

Vec3d unit(Vec3d v) { return v * (1 / norm(v)); }

// Unit vectors across a normal, evenly over half a turn; with two dimensions one, in the plane.
std::vector<Vec3d> tangents(Vec3d normal, int dimensions) {
  if (dimensions == 2) return {unit({normal.z, 0, -normal.x})};
  const Vec3d a = unit(cross(normal, std::abs(normal.z) < 0.7 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0}));
  const Vec3d b = cross(normal, a);
  std::vector<Vec3d> result;
  for (std::size_t k = 0; k < half_turn; ++k) {
    const double angle = pi * static_cast<double>(k) / half_turn;
    result.push_back(std::cos(angle) * a + std::sin(angle) * b);
  }
  return result;
}

}  // namespace

WallSurvey::WallSurvey(const Case& c, const Lattice& lattice, const WallSolids& solids)
    : c_(c),
      lattice_(lattice),
      solids_(solids),
      spacing_(c.spacing),
      particles_(solids.count()),
      thin_(solids.count()),
      steps_(solids.count()),
      dropped_(solids.count()),
      covered_(solids.count()) {
  for (const WallSpec& wall : c.walls) poses_.push_back(poses(wall.motion));
}

double WallSurvey::distance(Vec3d p, std::size_t body) const {
  return solids_.distance_to_company(lattice_.wrapped(p), body);
}

bool WallSurvey::open_at(Vec3d p, std::size_t body) const {
  return lattice_.in_domain(lattice_.wrapped(p)) && distance(p, body) >= 0;
}

WallSurvey::Look WallSurvey::look(Vec3d p, std::size_t body, const WallFace& face) const {
  Look look;
  look.foot = p + face.depth * face.normal;
  look.thickness = std::numeric_limits<double>::infinity();
  if (!open_at(look.foot + (touch * spacing_) * face.normal, body)) return look;
  look.thickness = thickness(look.foot, face.normal, body);
  look.step = face.depth < spacing_ && has_step(look.foot, face.normal, body);
  return look;
}

void WallSurvey::placed(std::size_t body, const Look& look) {
  ++particles_[body];
  Thin& thin = thin_[body];
  if (look.thickness < least_thickness - rounding) {
    if (thin.count == 0 || look.thickness < thin.thickness - touch)
      thin.thickness = look.thickness, thin.first = look.foot;
    ++thin.count;
  }
  if (look.step) steps_[body].add(look.foot);
}

// Along the normal into the wall [spacings], beyond the domain too; infinite from three on.
double WallSurvey::thickness(Vec3d foot, Vec3d normal, std::size_t body) const {
  constexpr double none = std::numeric_limits<double>::infinity();
  for (double t = stride * spacing_; t < least_thickness * spacing_;) {
    const Vec3d q = foot - t * normal;
    const double d = distance(q, body);
    if (d > touch * spacing_) {
      const double thick = (t - d) / spacing_;  // nothing at an edge itself
      return thick > touch && faces_back(q, normal, body) ? thick : none;
    }
    t += std::max(-d, stride * spacing_);
  }
  return none;
}

bool WallSurvey::faces_back(Vec3d p, Vec3d normal, std::size_t body) const {
  Vec3d away;
  for (int k = 0; k < 3; ++k) {
    Vec3d ahead = p, behind = p;
    ahead[k] += touch * spacing_, behind[k] -= touch * spacing_;
    away[k] = distance(ahead, body) - distance(behind, body);
  }
  return norm(away) > 0 && dot(unit(away), normal) < opposite;
}

// Up on one side and down on the other, in two directions next to each other, and even across one of them:
// corners may do the one or the other.
bool WallSurvey::has_step(Vec3d foot, Vec3d normal, std::size_t body) const {
  const std::vector<Vec3d> ways = tangents(normal, c_.dimensions);
  if (ways.size() == 1) return rises(foot, ways[0], body);
  for (std::size_t k = 0; k < ways.size(); ++k) {
    if (!rises(foot, ways[k], body)) continue;
    const Vec3d across = ways[(k + half_turn / 2) % half_turn];
    if (rises(foot, ways[(k + 1) % half_turn], body) && even(foot, across, body)) return true;
    if (rises(foot, ways[(k + half_turn - 1) % half_turn], body) && even(foot, across, body)) return true;
  }
  return false;
}

bool WallSurvey::rises(Vec3d foot, Vec3d way, std::size_t body) const {
  const Vec3d ahead = foot + (step_width * spacing_) * way, behind = foot - (step_width * spacing_) * way;
  if (!lattice_.in_domain(lattice_.wrapped(ahead)) || !lattice_.in_domain(lattice_.wrapped(behind)))
    return false;
  const double a = distance(ahead, body), b = distance(behind, body), height = step_height * spacing_;
  return std::min(a, b) < -height && std::max(a, b) > height;
}

bool WallSurvey::even(Vec3d foot, Vec3d way, std::size_t body) const {
  const double height = 0.5 * step_height * spacing_;
  return std::abs(distance(foot + spacing_ * way, body)) < height &&
         std::abs(distance(foot - spacing_ * way, body)) < height;
}

std::vector<WallSurvey::Pose> WallSurvey::poses(const WallMotion& motion) const {
  std::vector<Pose> poses;
  if (!motion.moves()) return poses;
  const double last = std::min(c_.output.end_time, motion.remove_at);
  for (int k = 1; k <= looks; ++k) {
    const BodyPose pose = motion.pose(last * k / looks);
    poses.push_back({pose.shift, rotation(pose.turn)});
  }
  return poses;
}

bool WallSurvey::comes_out(Vec3d p, std::size_t body) const {
  const Vec3d center = c_.walls[body].motion.center;
  for (const Pose& pose : poses_[body]) {
    const Vec3d there = lattice_.wrapped(center + pose.shift + pose.turned * (p - center));
    if (lattice_.in_domain(there) && open_beside(there)) return true;
  }
  return false;
}

// Whether no wall at rest is there.
bool WallSurvey::open_beside(Vec3d p) const {
  for (std::size_t b = 0; b < solids_.count(); ++b)
    if (!solids_.moves(b) && solids_[b].distance(p) < 0.5 * spacing_) return false;
  return true;
}

std::vector<std::string> WallSurvey::warnings() const {
  std::vector<std::string> lines;
  char number[40];
  for (std::size_t b = 0; b < particles_.size(); ++b) {
    const std::string wall = "wall '" + c_.walls[b].name + "'";
    const std::string all = " of its " + std::to_string(particles_[b]) + " particles";
    const Thin& thin = thin_[b];
    std::snprintf(number, sizeof number, "%.3g spacing%s", thin.thickness,
                  std::abs(thin.thickness - 1) < 5e-4 ? "" : "s");
    if (thin.count > 0)
      lines.push_back(wall + " is " + number + " thick at " + place(thin.first) +
                      ", where it is thinnest, and thinner than three spacings at " +
                      std::to_string(thin.count) + all +
                      ": fluid may pass, and heat; allowed: three spacings or more");
    if (steps_[b].count > 0)
      lines.push_back(wall + " has steps less than two spacings wide at " + std::to_string(steps_[b].count) +
                      all + ", the first at " + place(steps_[b].first) +
                      ": fluid meets them as a rough wall; allowed: a smooth surface or a smaller spacing");
    if (dropped_[b].count > 0)
      lines.push_back(wall + " has no face near " + std::to_string(dropped_[b].count) +
                      " lattice sites inside of it, the first at " + place(dropped_[b].first) +
                      ", which get no particle: fluid may pass");
    if (covered_[b].count > 0)
      lines.push_back(wall + " starts partly inside walls at rest, which keep " +
                      std::to_string(covered_[b].count) + " of its lattice sites, the first at " +
                      place(covered_[b].first) +
                      ": when it comes out of there that part of it is missing; allowed: a start outside of "
                      "them, or room for it by their 'subtract'");
  }
  return lines;
}

}  // namespace slagflow
