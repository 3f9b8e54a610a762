#include "host/geometry/stl_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <tuple>

#include "backend/error.hpp"
#include "host/geometry/sets.hpp"
#include "host/geometry/stl_surface.hpp"

namespace slagflow {
namespace {

constexpr std::size_t most_samples = 100;  // triangles of a body that tell on which side of another it lies
constexpr double on_surface = 1e-6;        // of a body's extent: as near as that a point tells nothing

// A triangle at one of its edges, from the corner of the lower number to the other, or backward.
struct EdgeUse {
  std::size_t low, high, triangle;
  bool backward;
  bool same_edge(const EdgeUse& u) const { return low == u.low && high == u.high; }
};

// Edge by edge, forward ones first.
std::vector<EdgeUse> edges_of(const std::vector<Corners>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t a = triangles[t][c], b = triangles[t][(c + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), t, a > b});
    }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& u, const EdgeUse& v) {
    return std::tie(u.low, u.high, u.backward, u.triangle) < std::tie(v.low, v.high, v.backward, v.triangle);
  });
  return uses;
}

// Where bodies touch along an edge: triangles of one body each way belong together; of what is left any two
// that run opposite ways, which lie alike where two bodies share a face.
void join_at_shared_edge(const EdgeUse* first, std::size_t pairs, Sets& groups) {
  std::vector<std::size_t> forward, backward;
  for (std::size_t k = 0; k < pairs; ++k) backward.push_back(first[pairs + k].triangle);
  for (std::size_t k = 0; k < pairs; ++k) {
    const std::size_t f = first[k].triangle;
    const auto same = std::find_if(backward.begin(), backward.end(),
                                   [&](std::size_t b) { return groups.root(b) == groups.root(f); });
    if (same == backward.end())
      forward.push_back(f);
    else
      backward.erase(same);
  }
  for (std::size_t k = 0; k < forward.size(); ++k) groups.join(forward[k], backward[k]);
}

enum class Edges { of_two_triangles, of_more };

void join_at_edges(const std::vector<EdgeUse>& uses, Edges which, Sets& groups) {
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].same_edge(uses[first])) ++last;
    const Edges kind = last - first > 2 ? Edges::of_more : Edges::of_two_triangles;
    if (kind == which) join_at_shared_edge(&uses[first], (last - first) / 2, groups);
  }
}

std::vector<std::vector<std::size_t>> bodies_of(const std::vector<Corners>& corners) {
  Sets groups(corners.size());
  const std::vector<EdgeUse> uses = edges_of(corners);
  join_at_edges(uses, Edges::of_two_triangles, groups);
  join_at_edges(uses, Edges::of_more, groups);
  std::vector<std::vector<std::size_t>> bodies;
  std::map<std::size_t, std::size_t> index;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const auto [found, fresh] = index.emplace(groups.root(t), bodies.size());
    if (fresh) bodies.emplace_back();
    bodies[found->second].push_back(t);
  }
  return bodies;
}

double enclosed_volume(const std::vector<Triangle>& triangles) {
  const Vec3d base = triangles.front()[0];
  double volume = 0;
  for (const Triangle& t : triangles) volume += dot(t[0] - base, cross(t[1] - base, t[2] - base)) / 6;
  return volume;
}

struct Body {
  std::vector<std::size_t> members;  // triangles of the surface
  std::vector<Triangle> triangles;
  double volume = 0;  // negative when wound inside out
  Vec3d lower, upper;
  std::size_t around = 0;            // other bodies that it is inside of
  std::shared_ptr<const Form> form;  // made when it is asked for

  Body(std::vector<std::size_t> of, const std::vector<Triangle>& all) : members(std::move(of)) {
    for (const std::size_t t : members) triangles.push_back(all[t]);
    volume = enclosed_volume(triangles);
    lower = upper = triangles.front()[0];
    for (const Triangle& t : triangles)
      for (const Vec3d& v : t)
        for (int k = 0; k < 3; ++k) lower[k] = std::min(lower[k], v[k]), upper[k] = std::max(upper[k], v[k]);
  }
  bool meets(const Body& b) const {
    for (int k = 0; k < 3; ++k)
      if (lower[k] > b.upper[k] || upper[k] < b.lower[k]) return false;
    return true;
  }
  double distance(Vec3d p) {
    if (!form) form = make_surface_form(triangles);
    return form->distance(p);
  }
};

// How many points of one body, corners or else middles of triangles, are inside and outside of another.
struct Sides {
  std::size_t inside = 0, outside = 0;

  Sides(const Body& of, Body& in) {
    const double near = on_surface * norm(in.upper - in.lower);
    const auto count = [&](Vec3d p) {
      const double d = in.distance(p);
      if (std::abs(d) > near) ++(d < 0 ? inside : outside);
    };
    const std::size_t step = std::max<std::size_t>(1, of.triangles.size() / most_samples);
    for (std::size_t t = 0; t < of.triangles.size(); t += step)
      for (const Vec3d& corner : of.triangles[t]) count(corner);
    if (inside + outside > 0) return;
    for (std::size_t t = 0; t < of.triangles.size(); t += step)
      count((1.0 / 3) * (of.triangles[t][0] + of.triangles[t][1] + of.triangles[t][2]));
  }
  bool within() const { return inside > 0 && outside == 0; }
  bool across() const { return inside > 0 && outside > 0; }
};

std::string place(const Body& b) {
  char text[120];
  const Vec3d middle = 0.5 * (b.lower + b.upper);
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", middle.x, middle.y, middle.z);
  return text;
}

void compare(Body& a, Body& b, const std::string& name) {
  if (!a.meets(b) || a.volume == 0 || b.volume == 0) return;
  const Sides a_in_b(a, b), b_in_a(b, a);
  if (a_in_b.within() && !b_in_a.within()) ++a.around;
  if (b_in_a.within() && !a_in_b.within()) ++b.around;
  if ((a_in_b.across() || b_in_a.across()) && (a.volume > 0) != (b.volume > 0))
    throw InputError(name + ": two bodies cross, around " + place(a) + " and " + place(b) +
                     " of the file, and are wound in opposite senses: allowed: the same sense, for a union, "
                     "or bodies that do not cross");
}

// Of a surface far from the origin, as at map coordinates; or empty.
std::string lost_digits(const std::vector<Triangle>& triangles) {
  Vec3d low = triangles.front()[0], high = low;
  for (const Triangle& triangle : triangles)
    for (const Vec3d& p : triangle)
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  constexpr double far = 1e4;  // of the surface's size
  if (std::max(norm(low), norm(high)) < far * norm(high - low)) return "";
  return ": it is far from the origin, where single precision, as binary STL has, does not hold its shape; "
         "export it around an origin that is near, and give that as translate";
}

}  // namespace

void turn_bodies_outward(std::vector<Triangle>& triangles, const std::vector<Corners>& corners,
                         const std::string& name) {
  std::vector<Body> bodies;
  for (std::vector<std::size_t>& members : bodies_of(corners))
    bodies.emplace_back(std::move(members), triangles);
  const auto flat = [](const Body& b) { return b.volume == 0; };
  if (std::all_of(bodies.begin(), bodies.end(), flat))
    throw InputError(name + ": the surface encloses no volume" + lost_digits(triangles));
  std::sort(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) { return a.lower.x < b.lower.x; });
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size() && bodies[b].lower.x <= bodies[a].upper.x; ++b)
      compare(bodies[a], bodies[b], name);
  for (const Body& body : bodies)
    if ((body.volume < 0) == (body.around % 2 == 0))
      for (const std::size_t t : body.members) std::swap(triangles[t][1], triangles[t][2]);
}

}  // namespace slagflow
