#include "core/pipeline/picture_agreement.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

constexpr std::size_t kColours = 3;
using Colour = std::array<double, kColours>;

// The mean of five by five pixels over a spot; false where it reaches beyond the frame. Here pixels begin at
// whole numbers.
bool spot_colour(const FrameView& frame, const Vec2& middle_px, double side_px, Colour& colour) {
  constexpr int kHalf = 2;
  constexpr double kCount = (2 * kHalf + 1) * (2 * kHalf + 1);
  const int bytes = bytes_per_pixel(frame.format);
  const double step_px = side_px / (2 * kHalf);
  if (!(middle_px.minCoeff() >= side_px && middle_px.x() < frame.width - side_px &&
        middle_px.y() < frame.height - side_px))
    return false;
  colour = {};
  for (int j = -kHalf; j <= kHalf; ++j) {
    const auto y = static_cast<std::ptrdiff_t>(middle_px.y() + j * step_px);
    for (int i = -kHalf; i <= kHalf; ++i) {
      const auto x = static_cast<std::ptrdiff_t>(middle_px.x() + i * step_px);
      const std::uint8_t* const pixel = frame.data + y * frame.stride_bytes + x * bytes;
      for (std::size_t c = 0; c < kColours; ++c) colour[c] += pixel[bytes == 1 ? 0 : c] / kCount;
    }
  }
  return true;
}

// The median of ratios, each to 2 %, of 1/8 to 8.
class MedianRatio {
 public:
  void add(double ratio) {
    const double place = (std::log2(ratio) / kOctaves + 1.0) * 0.5 * static_cast<double>(kBins);
    ++counts_[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(kBins - 1)))];
    ++total_;
  }
  double value() const {
    std::uint32_t below = 0;
    std::size_t bin = 0;
    while (bin + 1 < kBins && 2 * (below + counts_[bin]) < total_) below += counts_[bin++];
    return std::exp2(kOctaves * (2.0 * (static_cast<double>(bin) + 0.5) / static_cast<double>(kBins) - 1.0));
  }

 private:
  static constexpr std::size_t kBins = 256;
  static constexpr double kOctaves = 3.0;  // to either side

  std::array<std::uint32_t, kBins> counts_{};
  std::uint32_t total_ = 0;
};

// Calls action(colour here, colour there) for each sample of the item that both pictures show.
template <class Action>
void for_each_spot(std::uint8_t item, std::size_t view, const std::array<SurfaceGrid, 2>& grids,
                   const ViewPair& views, const TableCameras& camera_from_table,
                   const PictureAgreementParams& params, Action&& action) {
  const SurfaceGrid& grid = grids[view];
  const std::array<SurfaceView, 2> seen_by{surface_view(*views[0], camera_from_table[0]),
                                           surface_view(*views[1], camera_from_table[1])};
  for (int row = 0; row < grid.points.height; row += params.step) {
    for (int column = 0; column < grid.points.width; column += params.step) {
      if (grid.labels.at(column, row) != item || grid.evidence.at(column, row) == SurfaceEvidence::none)
        continue;
      const SurfacePoint& sample = grid.points.at(column, row);
      const Vec3 point_mm(sample.x_mm, sample.y_mm, sample.z_mm);
      std::array<Colour, 2> colours;
      const auto is_seen = [&](std::size_t v) {
        Vec2 pixel;
        return seen_by[v].find_pixel(point_mm, pixel) && seen_by[v].label_at(pixel) == item &&
               spot_colour(views[v]->frame, pixel + Vec2::Constant(0.5),
                           params.spot_mm * px_per_mm(seen_by[v], point_mm), colours[v]);
      };
      if (is_seen(view) && is_seen(1 - view)) action(colours[view], colours[1 - view]);
    }
  }
}

}  // namespace

double unlike_share(std::uint8_t item, const std::array<SurfaceGrid, 2>& grids, const ViewPair& views,
                    const TableCameras& camera_from_table, const PictureAgreementParams& params) {
  constexpr double kDark = 5.0;  // grey values: keeps ratios of black finite
  double most = 0.0;
  for (std::size_t v = 0; v < 2; ++v) {
    std::array<MedianRatio, kColours> ratios;
    for_each_spot(item, v, grids, views, camera_from_table, params, [&](const Colour& a, const Colour& b) {
      for (std::size_t c = 0; c < kColours; ++c) ratios[c].add((b[c] + kDark) / (a[c] + kDark));
    });
    const Colour ratio{ratios[0].value(), ratios[1].value(), ratios[2].value()};
    int compared = 0;
    int unlike = 0;
    for_each_spot(item, v, grids, views, camera_from_table, params, [&](const Colour& a, const Colour& b) {
      double difference = 0.0;
      for (std::size_t c = 0; c < kColours; ++c)
        difference = std::max(difference, std::abs(a[c] * ratio[c] - b[c]));
      ++compared;
      unlike += difference > params.difference ? 1 : 0;
    });
    if (compared >= params.min_samples) most = std::max(most, static_cast<double>(unlike) / compared);
  }
  return most;
}

}  // namespace traygauge
