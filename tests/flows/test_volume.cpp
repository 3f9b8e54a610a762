// Fluid keeps its volume however long it is sheared.
#include "flows/flow.hpp"

namespace slagflow {
namespace {

double mean_height(const FluidSnapshot& s) {
  double sum = 0;
  for (const auto& p : s.position) sum += static_cast<double>(p.z);
  return sum / static_cast<double>(s.position.size());
}

// How much higher the centre of the fluid is at a time than at the start [m].
double risen(const std::string& file, double time) {
  Flow flow(file);
  const double start = mean_height(flow.snapshot());
  flow.run(time);
  const double way = mean_height(flow.snapshot()) - start;
  std::printf("%s: %.6f m higher after %g s\n", file.c_str(), way, time);
  return way;
}

TEST(Volume, OfAFilmStaysWhenItIsShearedForLong) {
  EXPECT_NEAR(risen("verification/long_film.toml", 4), 0, 0.1 * 0.01);
}

TEST(Volume, OfWaterThatFillsAPotStays) {
  EXPECT_NEAR(risen("verification/full_pot.toml", 4), 0, 0.01 * 0.2);
}

}  // namespace
}  // namespace slagflow
