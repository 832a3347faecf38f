// Axes with ticks at round numbers.
#pragma once

#include <string>
#include <vector>

namespace traygauge {

struct Axis {
  std::string title;  // with the unit
  double low = 0.0;
  double high = 1.0;
  std::vector<double> ticks;
  int decimals = 0;  // of their labels
  bool is_logarithmic = false;

  // Where a value stands between `low` (0) and `high` (1); beyond them it is put to the nearer end.
  double place(double value) const;
};

// 1, 2 or 5 times a power of ten (Heckbert, "Nice numbers for graph labels", Graphics Gems 1990), at least
// `least` > 0.
double round_step(double least);

// From `low` to `high`, both widened to the next tick; about `intervals` of them. An empty or endless span
// becomes one of length 1.
Axis make_axis(const std::string& title, double low, double high, int intervals = 6);

// Ticks at 1, 2 and 5 times powers of ten, the span widened to the next of them. Needs 0 < low <= high.
Axis make_logarithmic_axis(const std::string& title, double low, double high);

}  // namespace traygauge
