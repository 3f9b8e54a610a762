#include "host/run/advice.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "host/run/check.hpp"

namespace slagflow {
namespace {

constexpr double coarse = 8, fine = 10;  // particles across
constexpr double long_time = 3600;       // [s]
constexpr double much_output = 5e9;      // [bytes]
constexpr double least_wall = 2.95;      // spacings

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

// Two digits, downwards.
double rounded_down(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::floor(value / unit * (1 + 1e-9)) * unit;
}

class Adviser {
 public:
  Adviser(const CaseCheck& check, const BuiltCase& built) : check_(check), built_(built) {}

  std::vector<std::string> lines() {
    advise_of_fluid();
    advise_of_walls();
    if (check_.run_time > long_time) advise_of_time();
    advise_of_files();
    advise_of_memory();
    return std::move(lines_);
  }

 private:
  // How many times as long a run of another spacing takes.
  double times(double spacing) const {
    return std::pow(check_.spacing / spacing, built_.setup.dimensions + 1);
  }
  std::string spacing_line(double spacing) const {
    const double factor = times(spacing);
    return format("resolution.spacing = %.3g: ", spacing) +
           (factor > 1 ? format("%.3g times the run time, ", factor)
                       : format("1/%.3g of the run time, ", 1 / factor));
  }

  // The narrower side of the narrowest inlet, in particles.
  double inlet_across() const {
    double least = std::numeric_limits<double>::infinity();
    for (const InletSetup& in : built_.setup.inlets)
      for (int axis = 0; axis < 3; ++axis) {
        double low = 1e300, high = -low;
        for (const Vec3d& p : in.origin) low = std::min(low, p[axis]), high = std::max(high, p[axis]);
        if (high - low > 0.5 * check_.spacing) least = std::min(least, (high - low) / check_.spacing + 1);
      }
    return least;
  }

  void advise_of_fluid() {
    double across = inlet_across();
    std::string what = "the narrowest inlet";
    if (check_.fluid_across <= across) across = check_.fluid_across, what = "the thinnest fluid";
    if (!(across < coarse)) return;
    const double spacing = rounded_down(check_.spacing * across / fine);
    lines_.push_back(spacing_line(spacing) + format("%.0f particles across ", fine) + what + ", which has " +
                     format("%.3g", across));
  }

  void advise_of_walls() {
    if (check_.wall.across >= least_wall) return;
    const Vec3d& p = check_.wall.place;
    const double lacking = (3 - check_.wall.across) * check_.spacing;
    lines_.push_back(
        "wall '" + check_.wall.name + "': " + format("%.3g m more", lacking) +
        format(" at (%.4g, %.4g, %.4g) m, or ", p.x, p.y, p.z) +
        format("resolution.spacing = %.3g", rounded_down(check_.spacing * check_.wall.across / 3)) +
        ": three spacings hold the fluid");
  }

  void advise_of_time() {
    const double across = std::min(check_.fluid_across, inlet_across());
    if (check_.exact_yield)
      lines_.push_back(
          format("numerics.yield = \"regularised\": about 1/%g of the run time, creeps below yield",
                 exact_yield_cost));
    if (across > fine + 2) {
      const double spacing = rounded_down(check_.spacing * across / fine);
      lines_.push_back(spacing_line(spacing) + format("%.0f particles across the thinnest fluid", fine));
    }
    if (built_.setup.numerics.viscous_step == ViscousStepping::explicit_step)
      lines_.emplace_back("numerics.viscous_step = \"implicit\": steps that viscosity does not shorten");
    advise_of_sound_speed();
    lines_.push_back(format("output.end_time = %.3g: an hour of it",
                            rounded_down(built_.resolved.output.last_time() * long_time / check_.run_time)));
  }

  // Where something else than the depth asks for short steps.
  void advise_of_sound_speed() {
    double by_depth = 0;
    for (const SoundSpeedTerm& term : built_.sound_speed_terms)
      if (term.name == "depth") by_depth = term.sound_speed();
    const double gain = check_.sound_speed / by_depth;
    if (by_depth > 0 && gain > 1.5)
      lines_.push_back(format("numerics.sound_speed = %.3g: 1/%.3g of the run time", by_depth, gain) +
                       ", enough for the weight of the fluid; blows compress it more");
  }

  void advise_of_files() {
    if (check_.output <= much_output) return;
    const double interval = built_.resolved.output.interval * check_.output / much_output;
    lines_.push_back(format("output.interval = %.2g: %.3g GB of snapshots in place of %.3g GB", interval,
                            much_output / 1e9, check_.output / 1e9));
  }

  void advise_of_memory() {
    const double memory =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (check_.memory <= 0.9 * memory) return;
    const double spacing =
        check_.spacing * std::pow(check_.memory / (0.8 * memory), 1.0 / built_.setup.dimensions);
    lines_.push_back(format("resolution.spacing = %.3g: %.3g GB of memory, which this machine has", spacing,
                            0.8 * memory / 1e9));
  }

  const CaseCheck& check_;
  const BuiltCase& built_;
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> advice(const CaseCheck& check, const BuiltCase& built) {
  return Adviser(check, built).lines();
}

}  // namespace slagflow
