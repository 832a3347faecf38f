// A curve through points that never overshoots them.
#pragma once

#include <vector>

namespace traygauge {

// Piecewise cubic through (x, y) with the slopes of Fritsch and Butland (1984; "PCHIP"); x ascends strictly.
class MonotoneCubic {
 public:
  MonotoneCubic(std::vector<double> x, std::vector<double> y);

  // Constant beyond both ends.
  double value(double x) const;
  double slope(double x) const;

 private:
  struct Place {
    std::size_t piece = 0;
    double share = 0.0;  // of the piece, 0 to 1
    double width = 0.0;
    bool is_outside = false;
  };
  Place find(double x) const;

  std::vector<double> x_;
  std::vector<double> y_;
  std::vector<double> slopes_;
};

}  // namespace traygauge
