#include "host/geometry/stl_plate.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "backend/error.hpp"
#include "host/geometry/stl_weld.hpp"

namespace slagflow {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;  // corners, the smaller number first

constexpr double flat = 1e-3;   // least share of normals that do not lie in a plane or along a line
constexpr double sharpest = 4;  // [thicknesses] that a corner is moved at most

class Plate {
 public:
  Plate(const std::vector<Triangle>& triangles, const std::string& name)
      : surface_(weld(triangles, name)), name_(name) {
    for (std::size_t t = 0; t < surface_.corners.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) sides_[edge(t, c)].push_back(t);
    for (const auto& [corners, triangles_there] : sides_)
      if (triangles_there.size() > 2)
        refuse(corners, "has an edge of " + std::to_string(triangles_there.size()) + " triangles",
               "one or two, as surfaces have");
    require_whole_edges();
    turn_alike();
  }

  std::vector<Triangle> of(double front, double back) {
    find_offsets();
    std::vector<Triangle> all;
    for (const Corners& c : surface_.corners) {
      all.push_back({moved(c[0], front), moved(c[1], front), moved(c[2], front)});
      all.push_back({moved(c[0], -back), moved(c[2], -back), moved(c[1], -back)});
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = c[k], b = c[(k + 1) % 3];
        if (sides_.at(std::minmax(a, b)).size() > 1) continue;
        all.push_back({moved(a, front), moved(a, -back), moved(b, -back)});
        all.push_back({moved(a, front), moved(b, -back), moved(b, front)});
      }
    }
    return all;
  }

 private:
  Edge edge(std::size_t t, std::size_t c) const {
    return std::minmax(surface_.corners[t][c], surface_.corners[t][(c + 1) % 3]);
  }

  // Whether a triangle runs through an edge from its smaller to its larger corner.
  bool forward(std::size_t t, const Edge& e) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (surface_.corners[t][c] == e.first && surface_.corners[t][(c + 1) % 3] == e.second) return true;
    return false;
  }

  // Where a corner lies on the edge of another triangle, the parts on both sides would get a gap behind it.
  void require_whole_edges() const {
    std::map<std::size_t, Vec3d> place;
    std::vector<Edge> rim;
    for (std::size_t t = 0; t < surface_.corners.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) place[surface_.corners[t][c]] = surface_.triangles[t][c];
    std::map<std::size_t, Vec3d> on_rim;
    for (const auto& [corners, triangles_there] : sides_) {
      if (triangles_there.size() != 1) continue;
      rim.push_back(corners);
      for (const std::size_t k : {corners.first, corners.second}) on_rim[k] = place[k];
    }
    for (const Edge& e : rim) {
      const Vec3d a = place[e.first], along = place[e.second] - a;
      const double length = norm(along), near = 2 * surface_.tolerance;
      for (const auto& [k, p] : on_rim) {
        const double at = dot(p - a, along) / length;
        if (at <= near || at >= length - near || norm(p - a - (at / length) * along) > near) continue;
        refuse(
            e, "has a corner at " + corner_text(p) + " m in the middle of an edge",
            "triangles that meet corner to corner; the exporter splits edges when its parts are one surface");
      }
    }
  }

  void turn_alike() {
    std::vector<bool> seen(surface_.corners.size(), false);
    for (std::size_t first = 0; first < seen.size(); ++first) {
      if (seen[first]) continue;
      std::vector<std::size_t> next{first};
      seen[first] = true;
      while (!next.empty()) {
        const std::size_t t = next.back();
        next.pop_back();
        for (std::size_t c = 0; c < 3; ++c) meet(t, edge(t, c), seen, next);
      }
    }
  }

  // Turns what lies beyond an edge as the triangle on this side, when it is seen for the first time.
  void meet(std::size_t t, const Edge& e, std::vector<bool>& seen, std::vector<std::size_t>& next) {
    for (const std::size_t other : sides_.at(e)) {
      if (other == t) continue;
      const bool alike = forward(other, e) != forward(t, e);
      if (seen[other] && !alike) refuse(e, "has one side only, like a Moebius strip", "two sides");
      if (seen[other]) continue;
      if (!alike) {
        std::swap(surface_.corners[other][1], surface_.corners[other][2]);
        std::swap(surface_.triangles[other][1], surface_.triangles[other][2]);
      }
      seen[other] = true;
      next.push_back(other);
    }
  }

  // The offset o of a corner with n.o = 1 for the normals n of its faces, by least squares weighted with the
  // angles of the faces there, and of those the shortest.
  void find_offsets() {
    std::map<std::size_t, Eigen::Matrix3d> squares;
    std::map<std::size_t, Eigen::Vector3d> sums;
    for (std::size_t t = 0; t < surface_.corners.size(); ++t) {
      const Triangle& x = surface_.triangles[t];
      const Vec3d area = cross(x[1] - x[0], x[2] - x[0]);
      if (!(norm(area) > 0)) continue;
      const Eigen::Vector3d n = Eigen::Vector3d(area.x, area.y, area.z) / norm(area);
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3d a = x[(c + 1) % 3] - x[c], b = x[(c + 2) % 3] - x[c];
        const double angle = std::atan2(norm(cross(a, b)), dot(a, b));
        const std::size_t corner = surface_.corners[t][c];
        squares.try_emplace(corner, Eigen::Matrix3d::Zero()).first->second += angle * n * n.transpose();
        sums.try_emplace(corner, Eigen::Vector3d::Zero()).first->second += angle * n;
        place_[corner] = x[c];
      }
    }
    for (const auto& [corner, square] : squares) offset_[corner] = shortest(square, sums.at(corner));
  }

  static Vec3d shortest(const Eigen::Matrix3d& square, const Eigen::Vector3d& sum) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(square);
    Eigen::Vector3d o = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      if (parts.eigenvalues()[k] > flat * parts.eigenvalues()[2])
        o += parts.eigenvectors().col(k) * (parts.eigenvectors().col(k).dot(sum) / parts.eigenvalues()[k]);
    if (o.norm() > sharpest) o *= sharpest / o.norm();
    return {o.x(), o.y(), o.z()};
  }

  Vec3d moved(std::size_t corner, double way) const { return place_.at(corner) + way * offset_.at(corner); }

  [[noreturn]] void refuse(const Edge& e, const std::string& what, const std::string& allowed) const {
    Vec3d from, to;
    for (std::size_t t = 0; t < surface_.corners.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        if (surface_.corners[t][c] == e.first) from = surface_.triangles[t][c];
        if (surface_.corners[t][c] == e.second) to = surface_.triangles[t][c];
      }
    throw InputError(name_ + ": the surface " + what + ", from " + corner_text(from) + " to " +
                     corner_text(to) + " m: allowed: " + allowed);
  }

  WeldedSurface surface_;
  const std::string& name_;
  std::map<Edge, std::vector<std::size_t>> sides_;  // triangles at each edge
  std::map<std::size_t, Vec3d> place_, offset_;     // of each corner; offset for a thickness of 1
};

}  // namespace

std::vector<Triangle> plate(const std::vector<Triangle>& surface, double thickness, PlateSide side,
                            const std::string& name) {
  const double front = side == PlateSide::front ? thickness : side == PlateSide::middle ? 0.5 * thickness : 0;
  return Plate(surface, name).of(front, thickness - front);
}

}  // namespace slagflow
