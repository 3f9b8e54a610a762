// The oracle of the implicit viscous step: its dense matrix, its right hand side and their solution.
//   m u + theta dt K (u - u_wall) = m u* - (1 - theta) dt K (v - u_wall),  (K u)_i = sum_j w_ij x_ij
//   (x_ij.(u_i - u_j)) w_ij = C 2 (d + 2) eta_ij V_i V_j w(r),  eta_ij the mean,
//   harmonic between fluids
#pragma once

#include <stdexcept>

#include "reference.hpp"

namespace reference {

// A square matrix by rows.
struct Dense {
  explicit Dense(std::size_t n) : size(n), entries(n * n) {}
  std::size_t size;
  std::vector<double> entries;
  double& operator()(std::size_t i, std::size_t j) { return entries[i * size + j]; }
  double operator()(std::size_t i, std::size_t j) const { return entries[i * size + j]; }
};

inline std::vector<double> multiply(const Dense& a, const std::vector<double>& x) {
  std::vector<double> y(a.size);
  for (std::size_t i = 0; i < a.size; ++i)
    for (std::size_t j = 0; j < a.size; ++j) y[i] += a(i, j) * x[j];
  return y;
}

inline std::vector<double> flatten(const std::vector<Vec>& v) {
  std::vector<double> x;
  for (const Vec& a : v) x.insert(x.end(), {a.x, a.y, a.z});
  return x;
}

// Solves A x = b by A = L L^T. Throws where A is not positive definite.
inline std::vector<double> solve_cholesky(Dense a, std::vector<double> b) {
  const std::size_t n = a.size;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j; i < n; ++i) {
      double s = a(i, j);
      for (std::size_t k = 0; k < j; ++k) s -= a(i, k) * a(j, k);
      if (i == j && !(s > 0)) throw std::runtime_error("the matrix is not positive definite");
      a(i, j) = i == j ? std::sqrt(s) : s / a(j, j);
    }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a(i, k) * b[k];
    b[i] /= a(i, i);
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a(k, i) * b[k];
    b[i] /= a(i, i);
  }
  return b;
}

// Adds s d d^T to the block (i, j) of 3 x 3.
inline void add_block(Dense& a, std::size_t i, std::size_t j, double s, Vec d) {
  const double c[3] = {d.x, d.y, d.z};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < 3; ++l) a(3 * i + k, 3 * j + l) += s * c[k] * c[l];
}

// K, and the momentum that moving walls feed in, K_wall u_wall.
struct ViscousOperator {
  Dense matrix;
  std::vector<double> from_walls;
};

inline double pair_weight(const World& w, double eta, double volumes, Vec d) {
  return w.correction * 2 * (w.dimensions + 2) * eta * volumes * viscous_weight(w, length(d));
}
// With heat that of the part without a yield stress.
inline double mean_viscosity(const Particle& p, const Particle& o) {
  if (p.fluid == o.fluid && p.key > 0) {
    const bool rim = p.solid != o.solid;
    const double a = rim ? p.viscosity : p.key, b = rim ? o.viscosity : o.key;
    return (p.viscosity + o.viscosity) / 2 * 4 * a * b / ((a + b) * (a + b));
  }
  return p.fluid == o.fluid ? (p.viscosity + o.viscosity) / 2 : 2 / (1 / p.viscosity + 1 / o.viscosity);
}

// What distances kept along the chords of a way add to K u: sum w_ij x_ij turn |v_ij|^2.
inline std::vector<double> along_chords(const World& w, double turn) {
  std::vector<Vec> sum(w.particles.size());
  for (std::size_t i = 0; i < sum.size(); ++i)
    for (std::size_t j = 0; j < sum.size(); ++j) {
      if (i == j) continue;
      const Particle &p = w.particles[i], &o = w.particles[j];
      const Vec slip = p.v - o.v;
      for_images(w, p.x, o.x, w.support, [&](Vec d) {
        sum[i] = sum[i] +
                 (pair_weight(w, mean_viscosity(p, o), p.volume * o.volume, d) * turn * dot(slip, slip)) * d;
      });
    }
  return flatten(sum);
}

inline ViscousOperator viscous_operator(const World& w) {
  const std::size_t n = w.particles.size();
  ViscousOperator result{Dense(3 * n), std::vector<double>(3 * n)};
  for (std::size_t i = 0; i < n; ++i) {
    const Particle& p = w.particles[i];
    for (std::size_t j = 0; j < n; ++j) {
      const Particle& o = w.particles[j];
      if (i == j) continue;
      for_images(w, p.x, o.x, w.support, [&](Vec d) {
        const double s = pair_weight(w, mean_viscosity(p, o), p.volume * o.volume, d);
        add_block(result.matrix, i, i, s, d);
        add_block(result.matrix, i, j, -s, d);
      });
    }
    for_wall_pairs(w, i, [&](const Wall& o, Vec d) {
      if (!o.sticks) return;
      const double s = no_slip_factor(w, o, d) * pair_weight(w, p.viscosity, p.volume * w.wall_volume(), d);
      add_block(result.matrix, i, i, s, d);
      const Vec drag = s * dot(d, o.v) * d;
      result.from_walls[3 * i] += drag.x, result.from_walls[3 * i + 1] += drag.y,
          result.from_walls[3 * i + 2] += drag.z;
    });
  }
  return result;
}

struct ViscousSystem {
  Dense matrix;
  std::vector<double> right_hand_side;
};

// The system of one step with the predicted velocities u*; the explicit part acts on the old velocities v.
inline ViscousSystem viscous_system(const World& w, const std::vector<Vec>& predicted, double dt,
                                    double theta) {
  const ViscousOperator k = viscous_operator(w);
  ViscousSystem s{Dense(k.matrix.size), flatten(predicted)};
  std::vector<Vec> old;
  for (const Particle& p : w.particles) old.push_back(p.v);
  const std::vector<double> explicit_part = multiply(k.matrix, flatten(old));
  const std::vector<double> chords = along_chords(w, w.turn(theta));
  for (std::size_t i = 0; i < s.matrix.size; ++i) {
    const double mass = w.particles[i / 3].mass;
    for (std::size_t j = 0; j < s.matrix.size; ++j) s.matrix(i, j) = theta * dt * k.matrix(i, j);
    s.matrix(i, i) += mass;
    s.right_hand_side[i] = mass * s.right_hand_side[i] + dt * k.from_walls[i] -
                           (1 - theta) * dt * explicit_part[i] - theta * dt * chords[i];
  }
  return s;
}

}  // namespace reference
