#include "firmware/plot/axis.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {

double Axis::place(double value) const {
  const double inside = std::clamp(value, low, high);
  if (is_logarithmic) return std::log(inside / low) / std::log(high / low);
  return (inside - low) / (high - low);
}

double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    // The tolerance keeps 0.2 at 0.2 although 2 * 0.1 is not exact.
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

Axis make_axis(const std::string& title, double low, double high, int intervals) {
  Axis axis;
  axis.title = title;
  if (!std::isfinite(low) || !std::isfinite(high)) low = high = 0.0;
  if (!(high > low)) high = low + 1.0;
  const double step = round_step((high - low) / std::max(intervals, 1));
  const auto first = std::llround(std::floor(low / step + 1e-9));
  const auto last = std::llround(std::ceil(high / step - 1e-9));
  for (auto i = first; i <= last; ++i) axis.ticks.push_back(static_cast<double>(i) * step);
  axis.low = axis.ticks.front();
  axis.high = axis.ticks.back();
  axis.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  return axis;
}

Axis make_logarithmic_axis(const std::string& title, double low, double high) {
  Axis axis;
  axis.title = title;
  axis.is_logarithmic = true;
  double tick = std::pow(10.0, std::floor(std::log10(low)));
  for (const double next : {2.0 * tick, 5.0 * tick}) {
    if (next <= low * (1.0 + 1e-9)) tick = next;
  }
  axis.ticks.push_back(tick);
  while (axis.ticks.size() < 2 || axis.ticks.back() < high * (1.0 - 1e-9))
    axis.ticks.push_back(round_step(1.5 * axis.ticks.back()));
  axis.low = axis.ticks.front();
  axis.high = axis.ticks.back();
  axis.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(axis.low) + 1e-9)));
  return axis;
}

}  // namespace traygauge
