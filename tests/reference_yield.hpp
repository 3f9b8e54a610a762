// The oracle of the implicit step with an exact yield stress: the dual problem over the stresses of all rows,
//   min over |lambda_i| <= tau_i of 1/2 (b - B^T lambda).A^-1 (b - B^T lambda),  u = A^-1 (b - B^T lambda),
// by projected gradients with Nesterov's momentum (A. Beck, M. Teboulle, SIAM J. Imaging Sci. 2 (2009) 183),
// all matrices dense, and its duality gap as the proof that it has arrived. A pair of two fluids has an
// unknown more, what the middle of the pair moves besides the mean of both: its halves shear by x.(u_i - u_j)
// + y and x.(u_i - u_j) - y.
#pragma once

#include "reference_viscous.hpp"

namespace reference {

// A row of B and its constant: dt V_i g [x.(u_i - u_j) + turn v_ij^2], or dt V_i g x.(u_i - u_wall).
struct StrainRow {
  std::size_t i, j;        // j == i: a wall
  Vec g;                   // [1/m]
  double offset;           // -g turn v_ij^2, or g . u_wall
  std::size_t slip = 0;    // where y is in u; 0: the pair has none
  double slip_weight = 0;  // [1/m^2] of y
};

inline double times(const StrainRow& r, const std::vector<double>& u) {
  auto at = [&](std::size_t k) { return Vec{u[3 * k], u[3 * k + 1], u[3 * k + 2]}; };
  if (r.i == r.j) return dot(r.g, at(r.i)) - r.offset;
  return dot(r.g, at(r.i) - at(r.j)) - r.offset + (r.slip > 0 ? r.slip_weight * u[r.slip] : 0);
}

// The numbers of the unknowns y, by the pair and the number of its image.
struct Slips {
  explicit Slips(const World& w) : particles(w.particles.size()) {
    const std::size_t n = particles;
    size = 3 * n;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        if (w.particles[i].fluid != w.particles[j].fluid)
          for_images(w, w.particles[i].x, w.particles[j].x, w.support, [&](Vec d) {
            places.push_back({i, j, d, size}), ++size;
          });
  }
  // Of the pair at separation d = x_i - x_j; its sign for the half of i.
  std::pair<std::size_t, double> of(std::size_t i, std::size_t j, Vec d) const {
    for (const Place& p : places) {
      if (p.i == i && p.j == j && length(p.d - d) < 1e-9) return {p.at, 1};
      if (p.i == j && p.j == i && length(p.d + d) < 1e-9) return {p.at, -1};
    }
    return {0, 0};
  }
  struct Place {
    std::size_t i, j;
    Vec d;
    std::size_t at;
  };
  std::size_t particles, size;
  std::vector<Place> places;
};

// The entries of G u of particle i; the same sum as in shear_rate_squared.
inline std::vector<StrainRow> strain_rows(const World& w, const Slips& slips, std::size_t i) {
  std::vector<StrainRow> rows;
  auto root = [&](Vec d, double volume) {
    return std::sqrt(w.correction * (w.dimensions + 2) * volume * viscous_weight(w, length(d)));
  };
  for (std::size_t j = 0; j < w.particles.size(); ++j)
    if (j != i)
      for_images(w, w.particles[i].x, w.particles[j].x, w.support, [&](Vec d) {
        const double g = root(d, w.particles[j].volume);
        const auto [at, sign] = slips.of(i, j, d);
        const Vec slip = w.particles[i].v - w.particles[j].v;
        rows.push_back({i, j, g * d, -g * w.turn(1) * dot(slip, slip), at, sign * g});
      });
  for_wall_pairs(w, i, [&](const Wall& wall, Vec d) {
    if (!wall.sticks) return;
    const Vec g = root(d, 2 * no_slip_factor(w, wall, d) * w.wall_volume()) * d;
    rows.push_back({i, i, g, dot(g, wall.v), 0, 0});
  });
  return rows;
}

struct YieldSolution {
  std::vector<double> velocity;
  std::vector<double> held;  // |lambda_i| / tau_i
  double gap = 0;            // primal less dual energy [J]: at least 1/2 sum m |u - u_exact|^2
};

class YieldOracle {
 public:
  // A u = b is the step of the viscous part alone; `yield`: tau_i [Pa].
  YieldOracle(const World& w, const ViscousSystem& s, std::vector<double> yield, double dt)
      : world_(w), system_{Dense(Slips(w).size), s.right_hand_side}, yield_(std::move(yield)), dt_(dt) {
    const Slips slips(w);
    for (std::size_t i = 0; i < w.particles.size(); ++i) rows_.push_back(strain_rows(w, slips, i));
    for (std::size_t i = 0; i < s.matrix.size; ++i)
      for (std::size_t j = 0; j < s.matrix.size; ++j) system_.matrix(i, j) = s.matrix(i, j);
    system_.right_hand_side.resize(slips.size);
    add_slips();
    factor();
  }

  YieldSolution solve(int iterations) {
    const double step = 1 / largest_eigenvalue();
    Stresses stress = zero(), ahead = stress;
    double t = 1;
    for (int k = 0; k < iterations; ++k) {
      const std::vector<double> u = velocity(ahead);
      Stresses next = ahead;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        for (std::size_t r = 0; r < rows_[i].size(); ++r) next[i][r] += step * times(rows_[i][r], u);
        project(next[i], yield_[i]);
      }
      const double t_next = (1 + std::sqrt(1 + 4 * t * t)) / 2;
      for (std::size_t i = 0; i < rows_.size(); ++i)
        for (std::size_t r = 0; r < rows_[i].size(); ++r)
          ahead[i][r] = next[i][r] + (t - 1) / t_next * (next[i][r] - stress[i][r]);
      stress = next, t = t_next;
    }
    return judge(stress);
  }

 private:
  using Stresses = std::vector<std::vector<double>>;

  static double size(const std::vector<double>& v) {
    double s = 0;
    for (double x : v) s += x * x;
    return std::sqrt(s);
  }
  static void project(std::vector<double>& v, double radius) {
    const double s = size(v);
    if (s > radius)
      for (double& x : v) x *= radius / s;
  }
  Stresses zero() const {
    Stresses s;
    for (const auto& row : rows_) s.emplace_back(row.size(), 0.0);
    return s;
  }

  // The halves dissipate V g^2 (eta_i (x.u + y)^2 + eta_j (x.u - y)^2): with the harmonic mean that A has
  // this lacks V (eta_i + eta_j) (g y + (eta_i - eta_j)/(eta_i + eta_j) g x.u)^2.
  void add_slips() {
    for (const auto& rows : rows_)
      for (const StrainRow& r : rows) {
        if (r.slip == 0 || r.i > r.j) continue;
        const double own = world_.particles[r.i].viscosity, other = world_.particles[r.j].viscosity;
        const double weight = dt_ * world_.particles[r.i].volume * (own + other);
        const Vec along = ((own - other) / (own + other)) * r.g;
        std::vector<std::pair<std::size_t, double>> terms{{r.slip, r.slip_weight}};
        const double c[3] = {along.x, along.y, along.z};
        for (std::size_t k = 0; k < 3; ++k)
          terms.push_back({3 * r.i + k, c[k]}), terms.push_back({3 * r.j + k, -c[k]});
        const double offset = (own - other) / (own + other) * r.offset;
        for (const auto& [p, a] : terms) {
          for (const auto& [q, b] : terms) system_.matrix(p, q) += weight * a * b;
          system_.right_hand_side[p] += weight * a * offset;
        }
      }
  }

  // The rows of A^-1, once.
  void factor() {
    const std::size_t n = system_.matrix.size;
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> e(n);
      e[k] = 1;
      inverse_.push_back(solve_cholesky(system_.matrix, e));
    }
  }
  std::vector<double> times_inverse(const std::vector<double>& b) const {
    std::vector<double> x(b.size());
    for (std::size_t i = 0; i < b.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j) x[i] += inverse_[i][j] * b[j];
    return x;
  }
  // b - dt sum V_i G_i^T lambda_i
  std::vector<double> force(const Stresses& stress, std::vector<double> b) const {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (std::size_t r = 0; r < rows_[i].size(); ++r) {
        const StrainRow& row = rows_[i][r];
        const Vec f = (dt_ * world_.particles[i].volume * stress[i][r]) * row.g;
        const double c[3] = {f.x, f.y, f.z};
        for (std::size_t k = 0; k < 3; ++k) {
          b[3 * row.i + k] -= c[k];
          if (row.j != row.i) b[3 * row.j + k] += c[k];
        }
        if (row.slip > 0) b[row.slip] -= dt_ * world_.particles[i].volume * stress[i][r] * row.slip_weight;
      }
    return b;
  }
  std::vector<double> velocity(const Stresses& s) const {
    return times_inverse(force(s, system_.right_hand_side));
  }

  // Of G A^-1 G^T dt V, by power iteration, with a margin.
  double largest_eigenvalue() const {
    Stresses v = zero();
    for (auto& row : v)
      for (std::size_t r = 0; r < row.size(); ++r) row[r] = 1 + static_cast<double>(r % 3);
    double value = 0;
    for (int k = 0; k < 50; ++k) {
      std::vector<double> u = times_inverse(force(v, std::vector<double>(system_.matrix.size)));
      double norm = 0;
      for (std::size_t i = 0; i < rows_.size(); ++i)
        for (std::size_t r = 0; r < v[i].size(); ++r) {
          StrainRow row = rows_[i][r];
          row.offset = 0;
          v[i][r] = -times(row, u), norm += v[i][r] * v[i][r];
        }
      value = std::sqrt(norm);
      for (auto& row : v)
        for (double& x : row) x /= value;
    }
    return 1.2 * value;
  }

  YieldSolution judge(const Stresses& stress) const {
    YieldSolution s{velocity(stress), {}, 0};
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      double rates = 0, work = 0;
      for (std::size_t r = 0; r < rows_[i].size(); ++r) {
        const double rate = times(rows_[i][r], s.velocity);
        rates += rate * rate, work += rate * stress[i][r];
      }
      s.gap += dt_ * world_.particles[i].volume * (yield_[i] * std::sqrt(rates) - work);
      s.held.push_back(yield_[i] > 0 ? size(stress[i]) / yield_[i] : 1);
    }
    return s;
  }

  const World& world_;
  ViscousSystem system_;
  std::vector<double> yield_;
  double dt_;
  std::vector<std::vector<StrainRow>> rows_;
  std::vector<std::vector<double>> inverse_;
};

}  // namespace reference
