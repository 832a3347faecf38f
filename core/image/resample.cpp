#include "core/image/resample.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/lens_lanes.hpp"
#include "core/image/gray_weights.hpp"

namespace traygauge {
namespace {

constexpr std::uint32_t kUnit = 256;  // fractions of a pixel in bilinear weights

// Frame positions of a run of target pixels in one row.
struct PositionBlock {
  std::array<float, kLensRun> x;
  std::array<float, kLensRun> y;
  int count = 0;
};

Vec2 frame_position(const LensModel& lens, const PinholeCamera& camera, const Vec2& target_pixel) {
  return lens.pixel(camera.ray(target_pixel));
}

// As frame_position, for kLensRun pixels in single precision, written to vectorise.
void compute_positions(const LensModel& lens, const PinholeCamera& camera, int left, int row,
                       PositionBlock& block) {
  const Vec2 first = camera.ray({static_cast<double>(left), static_cast<double>(row)});
  const auto first_x = static_cast<float>(first.x());
  const auto step_x = static_cast<float>(1.0 / camera.fx_px);
  const auto y = static_cast<float>(first.y());
  with_lens_lanes(lens, [&](const auto& lanes) {
    for (int i = 0; i < kLensRun; ++i) {
      const auto index = static_cast<std::size_t>(i);
      const LensLanes::Pixel pixel = lanes.pixel(first_x + step_x * static_cast<float>(i), y);
      block.x[index] = pixel.x;
      block.y[index] = pixel.y;
    }
  });
}

// Offsets of the samples of a target pixel, in the frame.
struct SubGrid {
  static constexpr std::size_t kMaxSamples = std::size_t{kMaxSamplesAcross} * kMaxSamplesAcross;
  std::array<float, kMaxSamples> x{};
  std::array<float, kMaxSamples> y{};
  int size = 0;
  float reach_px = 0.0F;
};

// The lens is linear enough over a block for one grid: its Jacobian there, by central differences.
SubGrid make_sub_grid(const LensModel& lens, const PinholeCamera& camera, const Vec2& centre, int per_axis) {
  SubGrid grid;
  grid.size = per_axis * per_axis;
  if (per_axis == 1) return grid;
  const Vec2 half_x(0.5, 0.0);
  const Vec2 half_y(0.0, 0.5);
  const Vec2 by_x =
      frame_position(lens, camera, centre + half_x) - frame_position(lens, camera, centre - half_x);
  const Vec2 by_y =
      frame_position(lens, camera, centre + half_y) - frame_position(lens, camera, centre - half_y);
  std::size_t index = 0;
  for (int j = 0; j < per_axis; ++j) {
    for (int i = 0; i < per_axis; ++i, ++index) {
      const Vec2 offset = by_x * ((i + 0.5) / per_axis - 0.5) + by_y * ((j + 0.5) / per_axis - 0.5);
      grid.x[index] = static_cast<float>(offset.x());
      grid.y[index] = static_cast<float>(offset.y());
      grid.reach_px = std::max(grid.reach_px, static_cast<float>(offset.cwiseAbs().maxCoeff()));
    }
  }
  return grid;
}

// Whether every sample of the block lies so deep in the frame that no coordinate needs clamping.
bool is_inside(const PositionBlock& block, float reach_px, int width, int height) {
  float low = block.x[0];
  float high_x = block.x[0];
  float high_y = block.y[0];
  for (std::size_t i = 0; i < kLensRun; ++i) {
    low = std::min(low, std::min(block.x[i], block.y[i]));
    high_x = std::max(high_x, block.x[i]);
    high_y = std::max(high_y, block.y[i]);
  }
  constexpr float kSlackPx = 0.01F;  // ten times the error of single precision (lens_lanes.hpp)
  return low - reach_px >= 0.0F && high_x + reach_px < static_cast<float>(width - 1) - kSlackPx &&
         high_y + reach_px < static_cast<float>(height - 1) - kSlackPx;
}

// Sums of weighted channels over the samples of one pixel.
template <int kChannels>
using ChannelSums = std::array<std::uint32_t, static_cast<std::size_t>(kChannels)>;

template <int kChannels>
void add_sample(const FrameView& frame, std::uint32_t x, std::uint32_t y, ChannelSums<kChannels>& sums) {
  const std::uint32_t right = x % kUnit;
  const std::uint32_t below = y % kUnit;
  const std::uint8_t* upper = frame.data + static_cast<std::ptrdiff_t>(y / kUnit) * frame.stride_bytes +
                              static_cast<std::ptrdiff_t>(x / kUnit) * kChannels;
  const std::uint8_t* lower = upper + frame.stride_bytes;
  const std::uint32_t lower_right = right * below;
  const std::uint32_t upper_right = right * kUnit - lower_right;
  const std::uint32_t lower_left = below * kUnit - lower_right;
  const std::uint32_t upper_left = kUnit * kUnit - right * kUnit - lower_left;
  for (int c = 0; c < kChannels; ++c) {
    sums[static_cast<std::size_t>(c)] += upper_left * upper[c] + upper_right * upper[c + kChannels] +
                                         lower_left * lower[c] + lower_right * lower[c + kChannels];
  }
}

// A position in 1 / kUnit pixels; clamped to where all four neighbours exist.
template <bool kClamp>
std::uint32_t to_fixed(float position, int size) {
  const float scaled = position * static_cast<float>(kUnit) + 0.5F;
  if constexpr (!kClamp) return static_cast<std::uint32_t>(static_cast<std::int32_t>(scaled));
  const auto last = static_cast<float>((size - 1) * static_cast<int>(kUnit) - 1);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::clamp(scaled, 0.0F, last)));
}

template <int kChannels>
std::uint8_t combine_channels(const ChannelSums<kChannels>& sums, const GrayWeights& weights, double scale) {
  if constexpr (kChannels == 1) return static_cast<std::uint8_t>(sums[0] * scale * kGrayOne + 0.5);
  const std::uint64_t total = std::uint64_t{weights.first} * sums[0] +
                              std::uint64_t{weights.second} * sums[kChannels / 2] +
                              std::uint64_t{weights.third} * sums[kChannels - 1];
  return static_cast<std::uint8_t>(static_cast<double>(total) * scale + 0.5);
}

template <int kChannels, bool kClamp>
void sample_block(const FrameView& frame, const PositionBlock& block, const SubGrid& grid,
                  std::uint8_t* out) {
  const GrayWeights weights = gray_weights(frame.format);
  const double scale = 1.0 / (static_cast<double>(kGrayOne) * kUnit * kUnit * grid.size);
  for (int i = 0; i < block.count; ++i) {
    const float x = block.x[static_cast<std::size_t>(i)];
    const float y = block.y[static_cast<std::size_t>(i)];
    if constexpr (kClamp) {
      const bool in_frame = x >= -0.5F && y >= -0.5F && x <= static_cast<float>(frame.width) - 0.5F &&
                            y <= static_cast<float>(frame.height) - 0.5F;
      if (!in_frame) {
        out[i] = 0;
        continue;
      }
    }
    ChannelSums<kChannels> sums{};
    for (std::size_t s = 0; s < static_cast<std::size_t>(grid.size); ++s) {
      add_sample<kChannels>(frame, to_fixed<kClamp>(x + grid.x[s], frame.width),
                            to_fixed<kClamp>(y + grid.y[s], frame.height), sums);
    }
    out[i] = combine_channels<kChannels>(sums, weights, scale);
  }
}

template <int kChannels>
void sample_frame(const FrameView& frame, const LensModel& lens, const Roi& cutout, int per_axis,
                  ImageView<std::uint8_t> gray) {
  PositionBlock block;
  for (int row = 0; row < cutout.height; ++row) {
    for (int left = 0; left < cutout.width; left += kLensRun) {
      block.count = std::min(kLensRun, cutout.width - left);
      compute_positions(lens, cutout.camera, left, row, block);
      const Vec2 centre(left + 0.5 * block.count, static_cast<double>(row));
      const SubGrid grid = make_sub_grid(lens, cutout.camera, centre, per_axis);
      std::uint8_t* out = gray.row(row) + left;
      if (is_inside(block, grid.reach_px, frame.width, frame.height)) {
        sample_block<kChannels, false>(frame, block, grid, out);
      } else {
        sample_block<kChannels, true>(frame, block, grid, out);
      }
    }
  }
}

}  // namespace

void resample_undistorted(const FrameView& frame, const LensModel& lens, const Roi& cutout,
                          ImageView<std::uint8_t> gray, const ResampleParams& params) {
  const double reduction = lens.pinhole.mean_focal_px() / cutout.camera.mean_focal_px();
  const int most = std::clamp(params.max_samples_per_axis, 1, kMaxSamplesAcross);
  const int per_axis = static_cast<int>(std::clamp(std::round(reduction), 1.0, static_cast<double>(most)));
  if (frame.format == PixelFormat::gray8) {
    sample_frame<1>(frame, lens, cutout, per_axis, gray);
  } else {
    sample_frame<3>(frame, lens, cutout, per_axis, gray);
  }
}

void resample_labels_undistorted(ImageView<const std::uint8_t> labels, const LensModel& lens,
                                 const Roi& cutout, ImageView<std::uint8_t> target) {
  PositionBlock block;
  for (int row = 0; row < cutout.height; ++row) {
    for (int left = 0; left < cutout.width; left += kLensRun) {
      block.count = std::min(kLensRun, cutout.width - left);
      compute_positions(lens, cutout.camera, left, row, block);
      std::uint8_t* out = target.row(row) + left;
      for (int i = 0; i < block.count; ++i) {
        const float x = std::floor(block.x[static_cast<std::size_t>(i)] + 0.5F);
        const float y = std::floor(block.y[static_cast<std::size_t>(i)] + 0.5F);
        const bool in_frame = x >= 0.0F && y >= 0.0F && x < static_cast<float>(labels.width) &&
                              y < static_cast<float>(labels.height);
        out[i] = in_frame ? labels.at(static_cast<int>(x), static_cast<int>(y)) : std::uint8_t{0};
      }
    }
  }
}

}  // namespace traygauge
