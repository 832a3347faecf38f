#include "core/quality/edge_blur.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/base/units.hpp"

namespace traygauge {
namespace {

constexpr int kStep_px =
    2;  // in both directions: a quarter of the edges says as much in a quarter of the time
constexpr int kBinsPerPixel = 32;   // of a width: the least limit, 1.5 px, is 48 of them
constexpr double kFootShare = 0.1;  // of the steepest slope: where the edge ends

using WidthHistogram = std::array<std::uint32_t, std::size_t{kEdgeReach_px} * kBinsPerPixel>;

// One of the four directions in which pixels neighbour each other.
struct EdgeDirection {
  int dx = 0;
  int dy = 0;
  int squared_length() const { return dx * dx + dy * dy; }
};

struct GrayRange {
  int dark = 0;
  int bright = 0;
  int contrast() const { return bright - dark; }
};

GrayRange find_gray_range(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                          std::uint8_t label) {
  std::array<std::uint32_t, kByteValues> counts{};
  std::uint32_t total = 0;
  for (int y = 0; y < gray.height; ++y) {
    for (int x = 0; x < gray.width; ++x) {
      if (labels.at(x, y) != label) continue;
      ++counts[gray.at(x, y)];
      ++total;
    }
  }
  const std::uint32_t tail = total / 50;
  GrayRange range{0, 255};
  for (std::uint32_t sum = counts[0]; sum <= tail && range.dark < 255;) {
    sum += counts[static_cast<std::size_t>(++range.dark)];
  }
  for (std::uint32_t sum = counts[255]; sum <= tail && range.bright > 0;) {
    sum += counts[static_cast<std::size_t>(--range.bright)];
  }
  return range;
}

// Grey values along a line across an edge, averaged over three parallel lines so that noise counts less.
class EdgeProfile {
 public:
  EdgeProfile(ImageView<const std::uint8_t> gray, int x, int y, EdgeDirection direction)
      : gray_(gray), x_(x), y_(y), direction_(direction) {}

  // Four times the grey value at step `t`.
  int value(int t) const {
    const int x = x_ + t * direction_.dx;
    const int y = y_ + t * direction_.dy;
    return 2 * gray_.at(x, y) + gray_.at(x - direction_.dy, y + direction_.dx) +
           gray_.at(x + direction_.dy, y - direction_.dx);
  }
  int slope(int t) const { return value(t + 1) - value(t - 1); }

 private:
  ImageView<const std::uint8_t> gray_;
  int x_;
  int y_;
  EdgeDirection direction_;
};

// Where the slope in this sense has faded, to the side `step`.
int find_foot(const EdgeProfile& profile, int step, int steepest) {
  int t = step;
  const int sign = steepest < 0 ? -1 : 1;
  while (std::abs(t) < kEdgeReach_px - 1 && sign * profile.slope(t) > kFootShare * std::abs(steepest))
    t += step;
  return t;
}

// A blurred step of this rise has the steepest slope rise / (σ √2π). The slope was taken over two steps, a
// box whose own variance, a third of a step squared, is no blur.
double edge_variance_px2(int rise, int slope, int squared_length) {
  const double width_steps = 2.0 * rise / slope;
  return squared_length * std::max(0.0, width_steps * width_steps / (2.0 * std::numbers::pi) - 1.0 / 3.0);
}

class EdgeCollector {
 public:
  EdgeCollector(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels, std::uint8_t label,
                int border_px, int min_rise)
      : gray_(gray), labels_(labels), label_(label), border_px_(border_px), min_rise_(min_rise) {}

  int collect(EdgeDirection direction, WidthHistogram& widths) const {
    widths = {};
    int edges = 0;
    // The flattest edge that still ends within reach.
    const int min_slope = std::max(2, min_rise_ / kEdgeReach_px);
    const int margin = kEdgeReach_px + 1;
    for (int y = margin; y < gray_.height - margin; y += kStep_px) {
      for (int x = margin; x < gray_.width - margin; x += kStep_px) {
        if (labels_.at(x, y) != label_) continue;
        const EdgeProfile profile(gray_, x, y, direction);
        const int slope = profile.slope(0);
        if (std::abs(slope) < min_slope || !is_crest(profile, slope) || !is_inside(x, y)) continue;
        const int rise = std::abs(profile.value(find_foot(profile, 1, slope)) -
                                  profile.value(find_foot(profile, -1, slope)));
        if (rise < min_rise_) continue;
        const double sigma_px =
            std::sqrt(edge_variance_px2(rise, std::abs(slope), direction.squared_length()));
        const auto bin = static_cast<std::size_t>(sigma_px * kBinsPerPixel);
        ++widths[std::min(bin, widths.size() - 1)];
        ++edges;
      }
    }
    return edges;
  }

 private:
  static bool is_crest(const EdgeProfile& profile, int slope) {
    return std::abs(slope) >= std::abs(profile.slope(-1)) && std::abs(slope) > std::abs(profile.slope(1));
  }
  bool is_inside(int x, int y) const {
    const int b = border_px_;
    return labels_.at(x - b, y - b) == label_ && labels_.at(x + b, y - b) == label_ &&
           labels_.at(x - b, y + b) == label_ && labels_.at(x + b, y + b) == label_;
  }

  ImageView<const std::uint8_t> gray_;
  ImageView<const std::uint8_t> labels_;
  std::uint8_t label_;
  int border_px_;
  int min_rise_;
};

double quantile_px(const WidthHistogram& widths, int edges, double quantile) {
  double left = quantile * edges;
  std::size_t bin = 0;
  while (bin + 1 < widths.size() && left > widths[bin]) left -= widths[bin++];
  return (static_cast<double>(bin) + 0.5) / kBinsPerPixel;
}

}  // namespace

EdgeBlur measure_edge_blur(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                           std::uint8_t label, const EdgeBlurParams& params) {
  const GrayRange range = find_gray_range(gray, labels, label);
  EdgeBlur blur{false, 0.0, range.dark, range.bright};
  if (range.contrast() < params.min_contrast) return blur;
  const int border_px = std::clamp(params.border_px, 0, kEdgeReach_px);
  const auto min_rise = static_cast<int>(4.0 * params.min_rise_fraction * range.contrast());
  const EdgeCollector collector(gray, labels, label, border_px, min_rise);
  constexpr std::array<EdgeDirection, 4> kDirections = {{{1, 0}, {1, 1}, {0, 1}, {-1, 1}}};
  WidthHistogram widths;
  for (const EdgeDirection direction : kDirections) {
    const int edges = collector.collect(direction, widths);
    if (edges < std::max(params.min_edges, 1)) continue;
    blur.is_measured = true;
    blur.sigma_px = std::max(blur.sigma_px, quantile_px(widths, edges, params.width_quantile));
  }
  return blur;
}

}  // namespace traygauge
