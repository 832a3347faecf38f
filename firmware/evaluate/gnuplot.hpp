// Plots drawn by gnuplot, which need not be installed.
#pragma once

#include <chrono>
#include <filesystem>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

namespace traygauge {

struct Plot {
  std::filesystem::path script;    // beside it lies common.gp, which is loaded first
  std::filesystem::path data;      // CSV; ARG1 in the script
  std::filesystem::path svg;       // ARG2; replaced
  std::vector<std::string> texts;  // ARG3, …
};

// A plot that gnuplot could not draw; what() names the plot and says what gnuplot said.
class PlotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr std::chrono::milliseconds kPlotTimeout{60'000};  // it takes a fraction of a second

// Draws them all, or tells `error` that gnuplot is not installed. Either way no plot is left that was drawn
// from other data. Throws PlotError.
void draw_plots(const std::vector<Plot>& plots, std::ostream& error,
                std::chrono::milliseconds timeout = kPlotTimeout);

}  // namespace traygauge
