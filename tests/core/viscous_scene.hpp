// The linear system of a scene, on the host.
#pragma once

#include "fluid/motion.hpp"
#include "reference_viscous.hpp"
#include "scene.hpp"
#include "viscosity/linear_system.hpp"
#include "viscosity/predictor.hpp"

namespace slagflow::testing_tools {

// Velocities with which the particles turn by spin dt as a rigid body, along chords, and go on besides.
inline void spin_along_chords(reference::World& world, Vec3d spin, double dt) {
  const Rotation turn = rotation(dt * spin);
  for (auto& p : world.particles) {
    const Vec3d x{p.x.x, p.x.y, p.x.z}, chord = (1 / dt) * (turn * x - x);
    p.v = reference::Vec{0.3, 0, -0.2} + reference::Vec{chord.x, chord.y, chord.z};
  }
}

// The system on the device, in the device's order of particles.
struct DeviceSystem {
  explicit DeviceSystem(Scene& s)
      : predicted(s.context, "predicted", s.fluid.count),
        by_pressure(s.context, "by pressure", s.fluid.count),
        given(s.context, "given", s.fluid.count),
        diagonal(s.context, "diagonal", s.fluid.count),
        right_hand_side(s.context, "right hand side", s.fluid.count),
        wall(s.context, "walls", s.fluid.count),
        weight(s.context, "weights", s.fluid_list.capacity()) {}

  PredictorOutput output() {
    return {predicted.span(), by_pressure.span(), given.span(),          {weight.span()},
            diagonal.span(),  wall.span(),        right_hand_side.span()};
  }
  LinearSystem system(const Scene& s) const {
    return {s.fluid.count, s.fluid_list.view(),    {weight.span()}, s.fluid.place.span(), diagonal.span(),
            wall.span(),   right_hand_side.span(), s.box,           s.flow.coupling};
  }

  Buffer<Quad> predicted, by_pressure, given, diagonal, right_hand_side;
  Buffer<Symmetric3> wall;
  Buffer<Real> weight;
};

// The same, downloaded and read in the order of ids.
class HostSystem {
 public:
  HostSystem(Scene& s, const DeviceSystem& d)
      : predicted(s.by_id(d.predicted.span())),
        by_pressure(s.by_id(d.by_pressure.span())),
        given(s.by_id(d.given.span())),
        diagonal(s.by_id(d.diagonal.span())),
        right_hand_side(s.by_id(d.right_hand_side.span())),
        id_(download(s.context, s.fluid.id.span())),
        list_(s.context, s.fluid_list.view()),
        weight_(download(s.context, d.weight.span())),
        x_(download(s.context, s.fluid.place.span())),
        wall_(download(s.context, d.wall.span())),
        device_diagonal_(download(s.context, d.diagonal.span())),
        place_(id_.size()),
        box_(s.box) {
    for (std::size_t row = 0; row < id_.size(); ++row) place_[static_cast<std::size_t>(id_[row])] = row;
  }

  // (A u) of particle i; u in the order of ids.
  Vec3 apply(std::size_t i, const std::vector<Quad>& u) const {
    std::vector<Quad> by_row(u.size());
    for (std::size_t k = 0; k < u.size(); ++k) by_row[place_[k]] = u[k];
    return system().apply(static_cast<Index>(place_[i]), host_span(by_row));
  }

  reference::Dense dense() const {
    const LinearSystem s = system();
    reference::Dense a(3 * id_.size());
    for (std::size_t row = 0; row < id_.size(); ++row) {
      const auto i = static_cast<std::size_t>(id_[row]);
      const auto number = static_cast<Index>(row);
      const Symmetric3 b = wall_[row];
      const Vec3 axis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          a(3 * i + static_cast<std::size_t>(k), 3 * i + static_cast<std::size_t>(l)) =
              static_cast<double>((b * axis[l])[k]) +
              (k == l ? static_cast<double>(s.diagonal[number].w) : 0);
      for (Index k = 0; k < s.links.length[number]; ++k) {
        const ListRow links = s.links.entries(number);
        const auto other = static_cast<std::size_t>(links.one(k));
        const auto j = static_cast<std::size_t>(id_[other]);
        const Vec3 d = box_.separation(xyz(x_[row]), xyz(x_[other]));
        const reference::Vec root =
            std::sqrt(static_cast<double>(s.weight.one(links.at(k)))) * to_host(quad(d, 0));
        reference::add_block(a, i, i, 1, root);
        reference::add_block(a, i, j, -1, root);
      }
    }
    return a;
  }

  double diagonal_entry(std::size_t i) const {
    return static_cast<double>(xyz(diagonal[i / 3])[static_cast<int>(i % 3)]);
  }

  std::vector<Quad> predicted, by_pressure, given, diagonal, right_hand_side;

 private:
  LinearSystem system() const {
    return {static_cast<Index>(id_.size()),
            list_.view(),
            {host_span(weight_)},
            host_span(x_),
            host_span(device_diagonal_),
            host_span(wall_),
            {},
            box_};
  }

  std::vector<Index> id_;
  HostList list_;
  std::vector<Real> weight_;
  std::vector<Quad> x_;
  std::vector<Symmetric3> wall_;
  std::vector<Quad> device_diagonal_;
  std::vector<std::size_t> place_;
  PeriodicBox box_;
};

inline HostSystem assemble(Scene& scene, double dt, double theta) {
  scene.upload();
  DeviceSystem system(scene);
  predict_and_assemble(scene.context, scene.pairs(), system.output(), static_cast<Real>(dt),
                       static_cast<Real>(theta));
  return {scene, system};
}

}  // namespace slagflow::testing_tools
