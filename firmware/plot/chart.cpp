#include "firmware/plot/chart.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

constexpr int kWidthPx = 800;
constexpr int kHeightPx = 520;
constexpr double kLeftPx = 76.0;
constexpr double kRightPx = 28.0;
constexpr double kTopPx = 70.0;
constexpr double kBottomPx = 104.0;  // ticks, title of the axis, legend
constexpr double kPlotRightPx = kWidthPx - kRightPx;
constexpr double kPlotBottomPx = kHeightPx - kBottomPx;
constexpr double kTickPx = 5.0;
constexpr double kBarGapPx = 0.6;
constexpr double kTitlePx = 19.0;
constexpr double kTextPx = 14.0;
constexpr double kTickTextPx = 13.0;
constexpr double kLegendGapPx = 26.0;
constexpr double kLegendSamplePx = 26.0;
constexpr double kCharacterPx = 0.53 * kTickTextPx;  // mean width of a character, to lay the legend out
constexpr const char* kMinus = "\u2212";
constexpr const char* kGridColour = "#e4e4e4";
constexpr const char* kShadeColour = "#009e73";
constexpr double kShadeOpacity = 0.12;
constexpr Stroke kFrame{"#444444", 1.0, ""};

void draw_titles(Svg& svg, const std::string& title, const std::string& subtitle) {
  svg.text({kLeftPx, 30.0}, title, {kTitlePx, kBlack, Anchor::start, true, false});
  svg.text({kLeftPx, 53.0}, subtitle, {kTextPx, "#555555", Anchor::start, false, false});
}

void draw_marker(Svg& svg, SvgPoint centre, const MarkerStyle& style) {
  const double r = style.radius_px;
  if (style.marker == Marker::dot) {
    svg.circle(centre, r, style.colour, style.opacity);
  } else {
    svg.rectangle({centre.x - r, centre.y - r}, 2.0 * r, 2.0 * r, style.colour, style.opacity);
  }
}

std::string tick_text(double tick, const Axis& axis) {
  const std::string number = fixed(std::abs(tick), axis.decimals);
  return tick < 0.0 ? kMinus + number : number;
}

}  // namespace

Chart::Chart(const std::string& title, const std::string& subtitle, Axis x, Axis y)
    : x_(std::move(x)), y_(std::move(y)), svg_(kWidthPx, kHeightPx) {
  draw_titles(svg_, title, subtitle);
  draw_grid();
}

double Chart::to_x(double value) const {
  return kLeftPx + x_.place(value) * (kPlotRightPx - kLeftPx);
}

double Chart::to_y(double value) const {
  return kPlotBottomPx - y_.place(value) * (kPlotBottomPx - kTopPx);
}

void Chart::draw_grid() {
  for (const double tick : x_.ticks)
    svg_.line({to_x(tick), kTopPx}, {to_x(tick), kPlotBottomPx}, {kGridColour, 1.0, ""});
  for (const double tick : y_.ticks)
    svg_.line({kLeftPx, to_y(tick)}, {kPlotRightPx, to_y(tick)}, {kGridColour, 1.0, ""});
}

void Chart::shade_y(double low, double high, const std::string& legend) {
  svg_.rectangle({kLeftPx, to_y(high)}, kPlotRightPx - kLeftPx, to_y(low) - to_y(high), kShadeColour,
                 kShadeOpacity);
  add_legend({LegendEntry::Kind::area, legend, {}, {}});
}

void Chart::shade_x(double low, double high, const std::string& legend) {
  svg_.rectangle({to_x(low), kTopPx}, to_x(high) - to_x(low), kPlotBottomPx - kTopPx, kShadeColour,
                 kShadeOpacity);
  add_legend({LegendEntry::Kind::area, legend, {}, {}});
}

void Chart::bars(const Histogram& histogram, const char* colour) {
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    if (histogram.counts[bin] == 0) continue;
    const double left = to_x(histogram.edge(bin)) + kBarGapPx;
    const double right = to_x(histogram.edge(bin + 1)) - kBarGapPx;
    const double top = to_y(histogram.share_percent(bin));
    svg_.rectangle({left, top}, right - left, kPlotBottomPx - top, colour, 0.85);
  }
}

void Chart::markers(const std::vector<DataPoint>& points, const MarkerStyle& style,
                    const std::string& legend) {
  if (points.empty()) return;
  for (const DataPoint& point : points) draw_marker(svg_, {to_x(point.x), to_y(point.y)}, style);
  add_legend({LegendEntry::Kind::marker, legend, style, {}});
}

void Chart::line(const std::vector<DataPoint>& points, const Stroke& stroke, const std::string& legend) {
  std::vector<SvgPoint> places;
  places.reserve(points.size());
  for (const DataPoint& point : points) places.push_back({to_x(point.x), to_y(point.y)});
  svg_.polyline(places, stroke);
  add_legend({LegendEntry::Kind::line, legend, {}, stroke});
}

void Chart::vertical(double x, const Stroke& stroke, const std::string& legend) {
  if (!(x >= x_.low && x <= x_.high)) return;
  svg_.line({to_x(x), kTopPx}, {to_x(x), kPlotBottomPx}, stroke);
  add_legend({LegendEntry::Kind::line, legend, {}, stroke});
}

void Chart::horizontal(double y, const Stroke& stroke, const std::string& legend) {
  if (!(y >= y_.low && y <= y_.high)) return;
  svg_.line({kLeftPx, to_y(y)}, {kPlotRightPx, to_y(y)}, stroke);
  add_legend({LegendEntry::Kind::line, legend, {}, stroke});
}

void Chart::add_legend(LegendEntry entry) {
  if (!entry.text.empty()) legend_.push_back(std::move(entry));
}

void Chart::draw_frame(Svg& svg) const {
  svg.line({kLeftPx, kPlotBottomPx}, {kPlotRightPx, kPlotBottomPx}, kFrame);
  svg.line({kLeftPx, kTopPx}, {kLeftPx, kPlotBottomPx}, kFrame);
  for (const double tick : x_.ticks) {
    svg.line({to_x(tick), kPlotBottomPx}, {to_x(tick), kPlotBottomPx + kTickPx}, kFrame);
    svg.text({to_x(tick), kPlotBottomPx + 20.0}, tick_text(tick, x_),
             {kTickTextPx, kBlack, Anchor::middle, false, false});
  }
  for (const double tick : y_.ticks) {
    svg.line({kLeftPx - kTickPx, to_y(tick)}, {kLeftPx, to_y(tick)}, kFrame);
    svg.text({kLeftPx - 9.0, to_y(tick) + 4.5}, tick_text(tick, y_),
             {kTickTextPx, kBlack, Anchor::end, false, false});
  }
  svg.text({0.5 * (kLeftPx + kPlotRightPx), kPlotBottomPx + 45.0}, x_.title,
           {kTextPx, kBlack, Anchor::middle, false, false});
  svg.text({24.0, 0.5 * (kTopPx + kPlotBottomPx)}, y_.title, {kTextPx, kBlack, Anchor::middle, false, true});
}

void Chart::draw_legend(Svg& svg) const {
  const double y = kHeightPx - 24.0;
  double x = kLeftPx;
  for (const LegendEntry& entry : legend_) {
    if (entry.kind == LegendEntry::Kind::area) {
      svg.rectangle({x, y - 11.0}, kLegendSamplePx - 6.0, 13.0, kShadeColour, 2.0 * kShadeOpacity);
    } else if (entry.kind == LegendEntry::Kind::marker) {
      MarkerStyle style = entry.marker;
      style.opacity = 1.0;
      draw_marker(svg, {x + 0.5 * (kLegendSamplePx - 6.0), y - 4.5}, style);
    } else {
      svg.line({x, y - 4.5}, {x + kLegendSamplePx - 6.0, y - 4.5}, entry.stroke);
    }
    svg.text({x + kLegendSamplePx, y}, entry.text, {kTickTextPx, kBlack, Anchor::start, false, false});
    x += kLegendSamplePx + kCharacterPx * static_cast<double>(count_characters(entry.text)) + kLegendGapPx;
  }
}

std::string Chart::str() const {
  Svg svg = svg_;
  draw_frame(svg);
  draw_legend(svg);
  return svg.str();
}

std::string compose_empty_chart(const std::string& title, const std::string& message) {
  Svg svg(kWidthPx, kHeightPx);
  draw_titles(svg, title, "");
  svg.text({0.5 * kWidthPx, 0.5 * kHeightPx}, message, {kTextPx, kGrey, Anchor::middle, false, false});
  return svg.str();
}

}  // namespace traygauge
