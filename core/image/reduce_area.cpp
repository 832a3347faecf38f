#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/lanes.hpp"
#include "core/image/resample.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kColours = bytes_per_pixel(PixelFormat::rgb8);

// A target edge lies at edge · source / target of the source: whole pixels, and a rest in 1 / target pixels.
// Everything stays an integer, so that the average is exact.
struct Edge {
  int pixel = 0;
  std::uint32_t rest = 0;
};

Edge edge_at(int index, int source_size, int target_size) {
  const std::int64_t position = static_cast<std::int64_t>(index) * source_size;
  return {static_cast<int>(position / target_size), static_cast<std::uint32_t>(position % target_size)};
}

// The product of two numbers of 16 bits is one for the vectoriser.
void add_row(const std::uint8_t* __restrict bytes, std::uint16_t weight, int count,
             std::uint32_t* __restrict sums) {
  for (int i = 0; i < count; ++i) {
    const std::uint16_t byte = bytes[i];
    sums[i] += std::uint32_t{byte} * std::uint32_t{weight};
  }
}

// Rows of pixels with kChannels bytes each, reduced to `width` x `height`.
template <std::size_t kChannels>
class AreaReducer {
 public:
  using Pixel = std::array<std::uint8_t, kChannels>;

  AreaReducer(ImageView<const std::uint8_t> bytes, int width, int height)
      : bytes_(bytes),
        source_width_(bytes.width / kBytes),
        width_(width),
        height_(height),
        area_(static_cast<double>(source_width_) * bytes.height) {}

  // Hands every pixel of the target to write(column, row, pixel), row by row.
  template <class Write>
  void run(const Write& write) {
    for (int row = 0; row < height_; ++row) reduce_row(row, write);
  }

 private:
  using Sums = std::array<std::uint64_t, kChannels>;
  static constexpr int kBytes = static_cast<int>(kChannels);  // a pixel

  template <class Write>
  void reduce_row(int row, const Write& write) {
    const Edge top = edge_at(row, bytes_.height, height_);
    const Edge bottom = edge_at(row + 1, bytes_.height, height_);
    const Edge step = edge_at(1, source_width_, width_);
    const auto unit = static_cast<std::uint32_t>(width_);
    Edge edge = step;
    int column = 0;
    Sums whole{};     // of the whole columns so far
    Sums previous{};  // up to the previous edge
    for (int left = 0; left < source_width_; left += kRowBlock) {
      const int end = std::min(left + kRowBlock, source_width_);
      sum_columns(top, bottom, left, end - left);
      int x = left;
      while (column < width_ && (edge.pixel < end || end == source_width_)) {
        for (; x < edge.pixel; ++x) add_column(x - left, whole);
        Pixel pixel;
        for (std::size_t c = 0; c < kChannels; ++c) {
          const std::uint64_t up_to = unit * whole[c] + std::uint64_t{edge.rest} * column_sums(x - left)[c];
          pixel[c] = mean(up_to - previous[c]);
          previous[c] = up_to;
        }
        write(column++, row, pixel);
        edge.pixel += step.pixel;
        edge.rest += step.rest;
        if (edge.rest >= unit) {
          edge.rest -= unit;
          ++edge.pixel;
        }
      }
      for (; x < end; ++x) add_column(x - left, whole);
    }
  }

  // Each source column's weighted sum over one target row, weights in 1 / height_ of a source pixel.
  void sum_columns(Edge top, Edge bottom, int left, int count) {
    sums_.fill(0);
    for (int y = top.pixel; y <= std::min(bottom.pixel, bytes_.height - 1); ++y) {
      const std::uint32_t end = y == bottom.pixel ? bottom.rest : static_cast<std::uint32_t>(height_);
      const std::uint32_t begin = y == top.pixel ? top.rest : 0U;
      if (end > begin) {
        add_row(bytes_.row(y) + static_cast<std::ptrdiff_t>(left) * kBytes,
                static_cast<std::uint16_t>(end - begin), count * kBytes, sums_.data());
      }
    }
  }

  const std::uint32_t* column_sums(int column) const {
    return sums_.data() + static_cast<std::ptrdiff_t>(column) * kBytes;
  }

  void add_column(int column, Sums& sums) const {
    const std::uint32_t* own = column_sums(column);
    for (std::size_t c = 0; c < kChannels; ++c) sums[c] += own[c];
  }

  std::uint8_t mean(std::uint64_t sum) const {
    return static_cast<std::uint8_t>((static_cast<double>(sum) + 0.5 * area_) / area_);
  }

  ImageView<const std::uint8_t> bytes_;
  int source_width_;
  int width_;
  int height_;
  double area_;  // of a target pixel, in 1 / width_ by 1 / height_ of a source pixel
  std::array<std::uint32_t, (kRowBlock + 1) * kChannels> sums_{};
};

}  // namespace

void reduce_area(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target) {
  AreaReducer<1>(source, target.width, target.height).run([&](int x, int y, const auto& pixel) {
    target.at(x, y) = pixel[0];
  });
}

void reduce_colours(const FrameView& frame, ImageView<std::uint8_t> rgb) {
  const int width = rgb.width / static_cast<int>(kColours);
  const auto pixel_at = [&](int x, int y) { return rgb.row(y) + x * std::ptrdiff_t{kColours}; };
  const int channels = bytes_per_pixel(frame.format);
  const ImageView<const std::uint8_t> bytes(frame.data, frame.width * channels, frame.height,
                                            frame.stride_bytes);
  if (frame.format == PixelFormat::gray8) {
    AreaReducer<1>(bytes, width, rgb.height).run([&](int x, int y, const auto& pixel) {
      std::fill_n(pixel_at(x, y), kColours, pixel[0]);
    });
    return;
  }
  const bool is_red_first = frame.format == PixelFormat::rgb8;
  AreaReducer<kColours>(bytes, width, rgb.height).run([&](int x, int y, const auto& pixel) {
    std::uint8_t* out = pixel_at(x, y);
    out[0] = pixel[is_red_first ? 0 : 2];
    out[1] = pixel[1];
    out[2] = pixel[is_red_first ? 2 : 0];
  });
}

}  // namespace traygauge
