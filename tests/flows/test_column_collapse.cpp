// Collapse of a water column, a = 57.15 mm wide and 2a high: the front Z = x/a at T = t sqrt(2g/a).
// J. C. Martin, W. J. Moyce, Phil. Trans. R. Soc. A 244 (1952) 312, table 2, n^2 = 2.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

struct Point {
  double t, z;
};
constexpr Point measured[] = {{0.41, 1.11}, {0.84, 1.22}, {1.19, 1.44}, {1.43, 1.67}, {1.63, 1.89},
                              {1.83, 2.11}, {1.98, 2.33}, {2.20, 2.56}, {2.32, 2.78}, {2.51, 3.00},
                              {2.65, 3.22}, {2.83, 3.44}, {2.98, 3.67}, {3.11, 3.89}, {3.33, 4.11}};
constexpr double a = 0.05715;  // [m]

// The clock of the experiment starts late, when the diaphragm breaks: the shift that fits best, |shift| <=
// 0.2.
double best_shift(const std::vector<Point>& run, const std::function<double(double)>& worst) {
  double best = 0;
  for (double shift = -0.2; shift <= 0.2001; shift += 0.01)
    if (worst(shift) < worst(best)) best = shift;
  EXPECT_FALSE(run.empty());
  return best;
}

TEST(ColumnCollapse, FrontFollowsMartinAndMoyce) {
  Flow flow("column_collapse.toml");
  const double scale = std::sqrt(2 * g / a);
  std::vector<Point> run;
  flow.run(3.7 / scale, [&] {
    // The front is where 0.1 % of the fluid has passed, not the foremost droplet.
    std::vector<double> x;
    for (const Vec3d& p : flow.snapshot().position) x.push_back(p.x);
    const auto rank = static_cast<std::ptrdiff_t>(x.size() - x.size() / 1000 - 1);
    std::nth_element(x.begin(), x.begin() + rank, x.end());
    run.push_back({flow.simulation().time() * scale, x[static_cast<std::size_t>(rank)] / a});
    return false;
  });
  const auto front = [&](double t) {
    std::size_t k = 1;
    while (k + 1 < run.size() && run[k].t < t) ++k;
    const double share = (t - run[k - 1].t) / (run[k].t - run[k - 1].t);
    return run[k - 1].z + share * (run[k].z - run[k - 1].z);
  };
  const auto worst = [&](double shift) {
    double error = 0;
    for (const Point& p : measured) error = std::max(error, std::abs(front(p.t + shift) / p.z - 1));
    return error;
  };
  const double shift = best_shift(run, worst);
  for (const Point& p : measured)
    std::printf("T %.2f  Z measured %.2f  computed %.2f (%+.1f %%)\n", p.t, p.z, front(p.t + shift),
                100 * (front(p.t + shift) / p.z - 1));
  std::printf("shift in T %+.2f, worst error %.1f %%\n", shift, 100 * worst(shift));
  EXPECT_LT(worst(shift), 0.10);
}

}  // namespace
}  // namespace slagflow
