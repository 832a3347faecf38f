// A diagram with two axes: title, grid, ticks, legend, and what is drawn into it in data coordinates.
#pragma once

#include <string>
#include <vector>

#include "firmware/plot/axis.hpp"
#include "firmware/plot/histogram.hpp"
#include "firmware/plot/svg.hpp"

namespace traygauge {

// Distinguishable by people who see colours differently (Okabe and Ito 2008).
inline constexpr const char* kBlue = "#0072b2";
inline constexpr const char* kOrange = "#d55e00";
inline constexpr const char* kGreen = "#009e73";
inline constexpr const char* kGrey = "#777777";
inline constexpr const char* kBlack = "#222222";

struct DataPoint {
  double x = 0.0;
  double y = 0.0;
};

enum class Marker { dot, square };

struct MarkerStyle {
  Marker marker = Marker::dot;
  const char* colour = kBlue;
  double radius_px = 4.0;
  double opacity = 0.55;
};

class Chart {
 public:
  Chart(const std::string& title, const std::string& subtitle, Axis x, Axis y);

  // Shaded between two values of an axis, over the whole chart.
  void shade_y(double low, double high, const std::string& legend);
  void shade_x(double low, double high, const std::string& legend);
  void bars(const Histogram& histogram, const char* colour);  // shares in per cent
  // A point outside the axes is drawn at their edge.
  void markers(const std::vector<DataPoint>& points, const MarkerStyle& style, const std::string& legend);
  void line(const std::vector<DataPoint>& points, const Stroke& stroke, const std::string& legend);
  // Over the whole chart; nothing where the value lies outside the axis or is NaN.
  void vertical(double x, const Stroke& stroke, const std::string& legend);
  void horizontal(double y, const Stroke& stroke, const std::string& legend);

  // The document; frame, ticks and legend are drawn over the data.
  std::string str() const;

 private:
  struct LegendEntry {
    enum class Kind { area, marker, line } kind = Kind::line;
    std::string text;
    MarkerStyle marker;
    Stroke stroke;
  };

  double to_x(double value) const;
  double to_y(double value) const;
  void draw_grid();
  void draw_frame(Svg& svg) const;
  void draw_legend(Svg& svg) const;
  void add_legend(LegendEntry entry);

  Axis x_;
  Axis y_;
  Svg svg_;
  std::vector<LegendEntry> legend_;
};

// A diagram that says why there is none.
std::string compose_empty_chart(const std::string& title, const std::string& message);

}  // namespace traygauge
