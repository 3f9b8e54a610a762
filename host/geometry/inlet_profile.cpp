#include "host/geometry/inlet_profile.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace slagflow {
namespace {

constexpr int points = 400;  // across a section
constexpr int curve = 2000;  // of a flow curve
constexpr int halvings = 60;

// Shear rate of a stress, by a table over the shear rate, which linear interpolation turns round.
class FlowCurve {
 public:
  // Up to a shear rate [1/s].
  FlowCurve(const Rheology& law, double fastest) {
    constexpr double decades = 10;
    for (int k = 0; k <= curve; ++k) {
      const double rate = fastest * std::pow(10.0, decades * (static_cast<double>(k) / curve - 1));
      const auto eta = static_cast<double>(viscosity(law, static_cast<Real>(rate)));
      rate_.push_back(rate), stress_.push_back(std::max(eta * rate, stress_.empty() ? 0 : stress_.back()));
    }
  }

  double largest_stress() const { return stress_.back(); }

  // Odd in the stress [Pa].
  double rate(double stress) const {
    const double size = std::abs(stress), sign = stress < 0 ? -1 : 1;
    if (size <= stress_.front()) return sign * rate_.front() * size / std::max(stress_.front(), 1e-300);
    if (size >= stress_.back()) return sign * rate_.back() * size / stress_.back();
    const auto k =
        static_cast<std::size_t>(std::upper_bound(stress_.begin(), stress_.end(), size) - stress_.begin());
    const double part = (size - stress_[k - 1]) / (stress_[k] - stress_[k - 1]);
    return sign * (rate_[k - 1] + part * (rate_[k] - rate_[k - 1]));
  }

 private:
  std::vector<double> rate_, stress_;
};

// Velocities at evenly spaced places from `first` on.
struct Section {
  double first, step;
  std::vector<double> velocity;

  double at(double place) const {
    const double k = std::clamp((place - first) / step, 0.0, static_cast<double>(points));
    const auto below = std::min(static_cast<std::size_t>(k), static_cast<std::size_t>(points - 1));
    const double part = k - static_cast<double>(below);
    return (1 - part) * velocity[below] + part * velocity[below + 1];
  }

  // Weighted by place^power, as in rings.
  double mean(int power) const {
    double sum = 0, weights = 0;
    for (int k = 0; k <= points; ++k) {
      const double weight = std::pow(first + step * k, power) * (k == 0 || k == points ? 0.5 : 1);
      sum += weight * velocity[static_cast<std::size_t>(k)], weights += weight;
    }
    return sum / weights;
  }
};

// From the last place, at a wall, inwards; `stress`: of a place.
template <class Stress>
Section integrate(const FlowCurve& law, double first, double last, const Stress& stress) {
  Section s{first, (last - first) / points, std::vector<double>(points + 1)};
  for (int k = points - 1; k >= 0; --k) {
    const double middle = s.first + s.step * (k + 0.5);
    const auto here = static_cast<std::size_t>(k);
    s.velocity[here] = s.velocity[here + 1] + s.step * law.rate(stress(middle));
  }
  return s;
}

// The value between two at which a growing function crosses a target.
template <class Function>
double bisect(double low, double high, double target, const Function& f) {
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (f(middle) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

SpeedShare share_of(Section section, int power) {
  const double mean = section.mean(power);
  for (double& v : section.velocity) v /= mean;
  return [section](double place) { return section.at(std::abs(place)); };
}

// Stress linear from the middle to the wall at `half`.
SpeedShare linear_stress(const Rheology& rheology, double half, double mean, int power) {
  const FlowCurve law(rheology, 1e4 * mean / half);
  const auto section = [&](double wall_stress) {
    return integrate(law, 0, half, [&](double y) { return wall_stress * y / half; });
  };
  const double stress = bisect(0, law.largest_stress(), mean,
                               [&](double wall_stress) { return section(wall_stress).mean(power); });
  return share_of(section(stress), power);
}

}  // namespace

SpeedShare developed_slot(const Rheology& law, double height, double mean) {
  return linear_stress(law, 0.5 * height, mean, 0);
}

SpeedShare developed_pipe(const Rheology& law, double radius, double mean) {
  return linear_stress(law, radius, mean, 1);
}

SpeedShare developed_annulus(const Rheology& rheology, double inner_radius, double radius, double mean) {
  const double gap = radius - inner_radius;
  const FlowCurve law(rheology, 1e4 * mean / gap);
  // The velocity of the inner_radius wall falls with the radius without stress, which is where it vanishes.
  const auto section = [&](double gradient) {
    const auto of = [&](double a) {
      return integrate(law, inner_radius, radius, [&](double r) { return 0.5 * gradient * (r - a * a / r); });
    };
    return of(bisect(inner_radius, radius, 0, [&](double a) { return -of(a).velocity.front(); }));
  };
  const double gradient =
      bisect(0, 4 * law.largest_stress() / gap, mean, [&](double g) { return section(g).mean(1); });
  return share_of(section(gradient), 1);
}

}  // namespace slagflow
