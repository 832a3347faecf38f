// A picture reduced to the mean grey of its blocks: enough to see whether two pictures show the same.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image_view/image_view.hpp"

namespace traygauge {

struct SteadinessParams {
  // Blocks that differ by more have other content. Sensor noise leaves below 1 of a block's mean, a lamp's
  // flicker a few; what an arm or a hand has moved differs by 20 to 100 at every edge.
  int max_block_difference = 16;
  double max_different_fraction = 0.002;  // of the blocks; an insect or a reflex is no other scene
};

// Of so many pixels; the last block may be cut.
constexpr int blocks_along(int pixels, int block_px) {
  return (pixels + block_px - 1) / block_px;
}

class BlockMeans {
 public:
  // Takes the memory for pictures of this size at most.
  void reserve(int width, int height);
  // Blocks are so wide and high from the next picture on.
  void set_block_px(int block_px) { block_px_ = block_px; }
  void compute(const FrameView& frame);
  void clear() { columns_ = rows_ = 0; }
  bool empty() const { return columns_ == 0; }
  std::span<const std::uint8_t> means() const { return means_; }  // row by row
  // Same size, same scene.
  bool agrees_with(const BlockMeans& other, const SteadinessParams& params) const;

 private:
  int block_px_ = 16;
  std::vector<std::uint8_t> means_;
  std::vector<std::uint32_t> sums_;  // of one row of blocks
  int width_ = 0;
  int height_ = 0;
  int columns_ = 0;
  int rows_ = 0;
};

}  // namespace traygauge
