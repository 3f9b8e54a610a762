// The coarse levels against dense products, and what conjugate gradients ask of a preconditioner.
#include <gtest/gtest.h>

#include <numeric>

#include "backend/device.hpp"
#include "core/viscous_scene.hpp"
#include "viscosity/solvers/multigrid.hpp"

namespace slagflow {
namespace {

using namespace testing_tools;

constexpr double dt = 2e-3;

// Several levels in each; the odd periodic rings too.
std::vector<SceneOptions> large_scenes() {
  return {{3, Surroundings::periodic, 7, 0.2, 6},  // rings of two cells
          {3, Surroundings::walls, 13, 0.2, 1},   {3, Surroundings::periodic, 15, 0.2, 2},
          {3, Surroundings::free, 14, 0.4, 3},    {2, Surroundings::walls, 40, 0.2, 4},
          {2, Surroundings::periodic, 40, 0.2, 5}};
}

// A scene's system with its coarse levels, and vectors on it in the device's order of rows.
class Coarsened : public testing::TestWithParam<SceneOptions> {
 protected:
  Coarsened() : scene_(GetParam()) {
    for (auto& p : scene_.world.particles) p.viscosity *= 100;
    scene_.upload();
    device_ = std::make_unique<DeviceSystem>(scene_);
    predict_and_assemble(scene_.context, scene_.pairs(), device_->output(), static_cast<Real>(dt), 1);
  }

  std::size_t size() const { return static_cast<std::size_t>(scene_.fluid.count); }
  std::vector<Quad> random_vector(Random& random) const {
    std::vector<Quad> result;
    for (std::size_t i = 0; i < size(); ++i) result.push_back(quad(to_real(random.vector(1)), 0));
    return result;
  }
  // A u, row by row on the host.
  std::vector<Vec3d> apply(const std::vector<Quad>& u) {
    const HostSystem host(scene_, *device_);
    const auto ids = download(scene_.context, scene_.fluid.id.span());
    std::vector<Quad> by_id(size());
    for (std::size_t row = 0; row < size(); ++row) by_id[static_cast<std::size_t>(ids[row])] = u[row];
    std::vector<Vec3d> result;
    for (std::size_t row = 0; row < size(); ++row)
      result.push_back(to_double(host.apply(static_cast<std::size_t>(ids[row]), by_id)));
    return result;
  }
  void find_and_assemble(CoarseMatrix& matrix, const RowCells& rows) {
    matrix.find(rows, scene_.fluid.count);
    matrix.assemble(device_->system(scene_), rows);
  }
  std::vector<Quad> precondition(Multigrid& multigrid, const std::vector<Quad>& r) {
    Buffer<Quad> from(scene_.context, "r"), to(scene_.context, "z", static_cast<Offset>(size()));
    from.upload(r);
    multigrid.precondition(device_->system(scene_), scene_.rows(), from.span(), to.span());
    std::vector<Quad> z;
    to.download(z);
    return z;
  }

  Scene scene_;
  std::unique_ptr<DeviceSystem> device_;
};

double product(const std::vector<Quad>& a, const std::vector<Quad>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(to_double(xyz(a[i])), to_double(xyz(b[i])));
  return sum;
}

// The coarse matrix on the host.
class HostCoarse {
 public:
  HostCoarse(Context& c, const CoarseView& v)
      : view_(v),
        block_(download(c, v.block)),
        neighbour_(download(c, v.aggregates.neighbour)),
        number_(download(c, v.aggregates.number)),
        cell_(download(c, v.aggregates.cell)) {
    view_.block = host_span(block_);
    view_.aggregates.neighbour = host_span(neighbour_), view_.aggregates.number = host_span(number_);
    view_.aggregates.cell = host_span(cell_);
  }
  std::size_t size() const { return cell_.size() * motions; }
  const AggregateGrid& grid() const { return view_.aggregates.grid; }
  Index cell(std::size_t aggregate) const { return cell_[aggregate]; }
  std::size_t number(Index cell) const {
    return static_cast<std::size_t>(number_[static_cast<std::size_t>(cell)]);
  }
  std::vector<double> apply(const std::vector<double>& x) const {
    std::vector<double> product(x.size());
    for (std::size_t row = 0; row < x.size(); ++row)
      for (int slot = 0; slot < neighbour_slots; ++slot) {
        const Index other = neighbour_[row / motions * neighbour_slots + static_cast<std::size_t>(slot)];
        if (other < 0) continue;
        for (int l = 0; l < motions; ++l)
          product[row] +=
              x[static_cast<std::size_t>(other) * motions + static_cast<std::size_t>(l)] *
              view_.entry(static_cast<Index>(row / motions), slot, static_cast<int>(row % motions), l);
      }
    return product;
  }
  double energy(const std::vector<double>& x) const {
    const std::vector<double> product = apply(x);
    return std::inner_product(x.begin(), x.end(), product.begin(), 0.0);
  }

 private:
  CoarseView view_;
  std::vector<double> block_;
  std::vector<Index> neighbour_, number_, cell_;
};

std::vector<double> random_motions(std::size_t size, Random& random) {
  std::vector<double> x(size);
  for (double& value : x) value = random.uniform(-1, 1);
  return x;
}

// (P x).A P x and the energy of x in the coarse matrix are one, but for the inertia of lone particles.
TEST_P(Coarsened, FirstLevelHoldsTheEnergyOfRigidMotions) {
  CoarseMatrix matrix(scene_.context);
  const RowCells rows = scene_.rows();
  find_and_assemble(matrix, rows);
  const HostCoarse coarse(scene_.context, matrix.view());
  const auto place = download(scene_.context, scene_.fluid.place.span());
  const auto diagonal = download(scene_.context, device_->diagonal.span());
  const auto start = download(scene_.context, rows.cell_start);
  Random random(7);
  for (int trial = 0; trial < 3; ++trial) {
    const std::vector<double> x = random_motions(coarse.size(), random);
    std::vector<Quad> u(size());
    double inertia = 0;
    for (std::size_t a = 0; a < coarse.size() / motions; ++a) {
      const RigidMotion m = load_motion(&x[a * motions]);
      const auto cell = static_cast<std::size_t>(coarse.cell(a));
      const auto last = static_cast<std::size_t>(start[cell + 1]);
      for (auto i = static_cast<std::size_t>(start[cell]); i < last; ++i) {
        Vec3d arm = to_double(xyz(place[i])) - coarse.grid().centre(coarse.grid().steps(coarse.cell(a)));
        for (int k = 0; k < 3; ++k) {
          const double period = static_cast<double>(scene_.box.period[k]);
          if (period > 0) arm[k] -= period * std::rint(arm[k] / period);
        }
        u[i] = quad(to_real(m.at(arm, coarse.grid().scale)), 0);
        inertia += 0.01 * static_cast<double>(diagonal[i].w) * dot(m.rotation, m.rotation);
      }
    }
    const auto au = apply(u);
    double energy = 0;
    for (std::size_t i = 0; i < size(); ++i) energy += dot(to_double(xyz(u[i])), au[i]);
    EXPECT_NEAR(coarse.energy(x), energy + inertia, 1e-5 * energy);  // u is single precision
  }
}

TEST_P(Coarsened, NextLevelHoldsTheEnergyOfItsPartsAsTheyMove) {
  CoarseMatrix finer(scene_.context), matrix(scene_.context);
  find_and_assemble(finer, scene_.rows());
  matrix.find(finer.view());
  matrix.assemble(finer.view());
  const HostCoarse fine(scene_.context, finer.view()), coarse(scene_.context, matrix.view());
  EXPECT_LT(coarse.size(), fine.size());
  Random random(8);
  const std::vector<double> x = random_motions(coarse.size(), random);
  std::vector<double> parts(fine.size());
  for (std::size_t a = 0; a < fine.size() / motions; ++a) {
    const Index cell = fine.cell(a), parent = fine.grid().parent(cell, coarse.grid());
    const Vec3d arm =
        fine.grid().centre(fine.grid().steps(cell)) - coarse.grid().centre(coarse.grid().steps(parent));
    const RigidMotion m = load_motion(&x[coarse.number(parent) * motions]);
    // Rotations are speeds at the level's scale, which doubles.
    store_motion({m.at(arm, coarse.grid().scale), 0.5 * m.rotation}, &parts[a * motions]);
  }
  const double energy = fine.energy(parts);
  EXPECT_NEAR(coarse.energy(x), energy, 1e-11 * energy);
}

// Of the whole matrix, whatever its size.
TEST_P(Coarsened, DenseInverseTimesTheMatrixIsOne) {
  CoarseMatrix finer(scene_.context), matrix(scene_.context);
  find_and_assemble(finer, scene_.rows());
  matrix.find(finer.view());
  matrix.assemble(finer.view());
  DenseInverse dense(scene_.context);
  dense.resize(matrix.aggregates());
  dense.launch_inversion(matrix.view());
  const HostCoarse coarse(scene_.context, matrix.view());
  const std::vector<double> inverse = download(scene_.context, dense.span());
  const std::size_t n = coarse.size();
  ASSERT_EQ(inverse.size(), n * n);
  double largest = 0;
  for (std::size_t column = 0; column < n; ++column) {
    std::vector<double> unit(n);
    unit[column] = 1;
    const std::vector<double> entries = coarse.apply(unit);  // a column of the symmetric matrix
    for (std::size_t row = 0; row < n; ++row) {
      double sum = row == column ? -1 : 0;
      for (std::size_t l = 0; l < n; ++l) sum += inverse[row * n + l] * entries[l];
      largest = std::max(largest, std::fabs(sum));
    }
  }
  EXPECT_LT(largest, 1e-11);  // rounding leaves 4e-16 to 1.3e-13
}

TEST_P(Coarsened, LevelsArePreparedForOneArrangementOfTheRows) {
  Multigrid multigrid(scene_.context);
  RowCells rows = scene_.rows();
  multigrid.prepare(rows, scene_.fluid.count);
  EXPECT_FALSE(multigrid.prepared(rows));  // nothing tells when these rows change
  rows.arrangement = 5;
  multigrid.prepare(rows, scene_.fluid.count);
  EXPECT_TRUE(multigrid.prepared(rows));
  const std::int64_t waits = scene_.context.counts().waits;
  multigrid.prepare(rows, scene_.fluid.count);
  multigrid.build(device_->system(scene_), rows);
  EXPECT_EQ(scene_.context.counts().waits, waits);
  rows.arrangement = 6;
  EXPECT_FALSE(multigrid.prepared(rows));
}

TEST_P(Coarsened, PreconditionerIsSymmetricAndPositive) {
  Multigrid multigrid(scene_.context);
  multigrid.prepare(scene_.rows(), scene_.fluid.count);
  multigrid.build(device_->system(scene_), scene_.rows());
  Random random(5);
  for (int trial = 0; trial < 5; ++trial) {
    const auto a = random_vector(random), b = random_vector(random);
    const auto ma = precondition(multigrid, a), mb = precondition(multigrid, b);
    const double forth = product(b, ma), back = product(a, mb),
                 size = std::sqrt(product(a, ma) * product(b, mb));
    EXPECT_NEAR(forth, back, 1e-5 * size);
    EXPECT_GT(product(a, ma), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(, Coarsened, testing::ValuesIn(large_scenes()), [](const auto& p) {
  return scene_name(p.param) + "By" + std::to_string(p.param.particles_across);
});

}  // namespace
}  // namespace slagflow
