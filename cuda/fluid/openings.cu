#include <algorithm>

#include "fluid/openings.hpp"

namespace slagflow {

double FeedRate::speed_at(double now) const {
  if (now <= time.front()) return speed.front();
  if (now >= time.back()) return speed.back();
  const auto k = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), now) - time.begin());
  const double part = (now - time[k - 1]) / (time[k] - time[k - 1]);
  return speed[k - 1] + part * (speed[k] - speed[k - 1]);
}

double FeedRate::at(double now) const { return now < start || now >= stop ? 0 : speed_at(now); }

double FeedRate::integral(double now) const {
  if (now <= time.front()) return (now - time.front()) * speed.front();
  double sum = 0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    const double end = smaller(now, time[k]);
    sum += 0.5 * (end - time[k - 1]) * (speed[k - 1] + speed_at(end));
    if (now <= time[k]) return sum;
  }
  return sum + (now - time.back()) * speed.back();
}

double FeedRate::travelled(double now) const {
  const double end = smaller(now, stop);
  return end > start ? integral(end) - integral(start) : 0;
}

double FeedRate::fastest() const { return *std::max_element(speed.begin(), speed.end()); }

}  // namespace slagflow
