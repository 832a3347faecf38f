#include "firmware/station/block_means.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace traygauge {

void BlockMeans::reserve(int width, int height) {
  means_.reserve(static_cast<std::size_t>(blocks_along(width, block_px_)) *
                 static_cast<std::size_t>(blocks_along(height, block_px_)));
  sums_.reserve(static_cast<std::size_t>(blocks_along(width, block_px_)));
}

void BlockMeans::compute(const FrameView& frame) {
  width_ = frame.width;
  height_ = frame.height;
  columns_ = blocks_along(width_, block_px_);
  rows_ = blocks_along(height_, block_px_);
  means_.clear();
  const int pixel_bytes = bytes_per_pixel(frame.format);
  for (int top = 0; top < height_; top += block_px_) {
    sums_.assign(static_cast<std::size_t>(columns_), 0);
    const int bottom = std::min(top + block_px_, height_);
    for (int y = top; y < bottom; ++y) {
      const std::uint8_t* pixel = frame.data + y * frame.stride_bytes;
      for (int column = 0; column < columns_; ++column) {
        const int bytes = pixel_bytes * std::min(block_px_, width_ - column * block_px_);
        std::uint32_t sum = 0;
        for (int i = 0; i < bytes; ++i) sum += pixel[i];
        sums_[static_cast<std::size_t>(column)] += sum;
        pixel += bytes;
      }
    }
    for (int column = 0; column < columns_; ++column) {
      const int pixels = std::min(block_px_, width_ - column * block_px_) * (bottom - top);
      means_.push_back(static_cast<std::uint8_t>(sums_[static_cast<std::size_t>(column)] /
                                                 static_cast<std::uint32_t>(pixels * pixel_bytes)));
    }
  }
}

bool BlockMeans::agrees_with(const BlockMeans& other, const SteadinessParams& params) const {
  if (width_ != other.width_ || height_ != other.height_ || empty() || other.empty()) return false;
  std::size_t different = 0;
  for (std::size_t i = 0; i < means_.size(); ++i) {
    if (std::abs(means_[i] - other.means_[i]) > params.max_block_difference) ++different;
  }
  return static_cast<double>(different) <= params.max_different_fraction * static_cast<double>(means_.size());
}

}  // namespace traygauge
