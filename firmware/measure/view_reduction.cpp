#include "firmware/measure/view_reduction.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace traygauge {
namespace {

PictureSize reduced_size(PictureSize size, int factor) {
  return {size.width / factor, size.height / factor};
}

Picture mean_of(const Picture& picture, int factor) {
  Picture result(reduced_size(picture.size, factor), picture.format);
  const auto channels = static_cast<std::size_t>(bytes_per_pixel(picture.format));
  const auto stride = static_cast<std::size_t>(picture.stride_bytes());
  const auto step = static_cast<std::size_t>(factor);
  const std::size_t row_samples = static_cast<std::size_t>(result.size.width) * channels;
  const std::size_t count = step * step;
  for (std::size_t y = 0; y < static_cast<std::size_t>(result.size.height); ++y) {
    for (std::size_t i = 0; i < row_samples; ++i) {
      const std::size_t column = i / channels * step * channels + i % channels;
      std::size_t sum = count / 2;
      for (std::size_t j = 0; j < step; ++j) {
        const std::uint8_t* samples = &picture.pixels[(y * step + j) * stride + column];
        for (std::size_t k = 0; k < step; ++k) sum += samples[k * channels];
      }
      result.pixels[y * row_samples + i] = static_cast<std::uint8_t>(sum / count);
    }
  }
  return result;
}

// Of as many pixels of two labels one counts by the place, so that borders do not move to one side.
std::uint8_t most_frequent(const std::array<std::uint8_t, 16>& labels, std::size_t count, bool takes_last) {
  const auto* const end = labels.begin() + static_cast<std::ptrdiff_t>(count);
  std::uint8_t winner = labels[0];
  if (std::all_of(labels.begin(), end, [winner](std::uint8_t label) { return label == winner; }))
    return winner;
  std::ptrdiff_t most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::ptrdiff_t votes = std::count(labels.begin(), end, labels[i]);
    if (votes < most || (votes == most && !takes_last)) continue;
    most = votes;
    winner = labels[i];
  }
  return winner;
}

Picture majority_of(const Picture& labels, int factor) {
  Picture result(reduced_size(labels.size, factor), labels.format);
  const auto stride = static_cast<std::size_t>(labels.size.width);
  const auto width = static_cast<std::size_t>(result.size.width);
  const auto step = static_cast<std::size_t>(factor);
  std::array<std::uint8_t, 16> block{};
  for (std::size_t y = 0; y < static_cast<std::size_t>(result.size.height); ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t j = 0; j < step; ++j) {
        std::copy_n(&labels.pixels[(y * step + j) * stride + x * step], step, &block.at(j * step));
      }
      result.pixels[y * width + x] = most_frequent(block, step * step, (x + y) % 2 == 1);
    }
  }
  return result;
}

}  // namespace

int reduction_of(PictureSize size) {
  return (std::max(size.width, size.height) + kMaxMeasuredSide - 1) / kMaxMeasuredSide;
}

void reduce_view(LoadedView& view, int factor) {
  static_assert((kMaxPictureSide + kMaxMeasuredSide - 1) / kMaxMeasuredSide <= 4,
                "a block of labels holds 16");
  view.picture = mean_of(view.picture, factor);
  if (!view.labels.pixels.empty()) view.labels = majority_of(view.labels, factor);
}

CameraDescription reduce_where_larger(LoadedView& view, const CameraDescription& camera) {
  const int factor = reduction_of(view.picture.size);
  if (factor == 1) return camera;
  reduce_view(view, factor);
  return reduced(camera, factor);
}

CameraDescription reduced(const CameraDescription& camera, int factor) {
  CameraDescription cut = camera;  // by what does not fill a block
  const PictureSize size = reduced_size(camera.size, factor);
  cut.size = {size.width * factor, size.height * factor};
  return scaled(cut, size);
}

}  // namespace traygauge
