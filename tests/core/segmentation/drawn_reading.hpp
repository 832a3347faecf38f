// What a network might read in a square picture, drawn by hand.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/segmentation/picture_reading.hpp"

namespace traygauge::test {

inline constexpr int kDrawnEmbedding = 4;

// Values are told in steps of 1/32.
class DrawnReading {
 public:
  DrawnReading(int side_px, int cell_px)
      : cells_((side_px + cell_px - 1) / cell_px),
        cell_px_(cell_px),
        margins_(static_cast<std::size_t>(cells_ * cells_)),
        embedding_(static_cast<std::size_t>(cells_ * cells_) * kDrawnEmbedding) {}

  // Gives each cell its margin, and the numbers of its embedding by channel, by the cell's middle.
  template <class MarginOf, class EmbeddingOf>
  void draw(MarginOf&& margin_of, EmbeddingOf&& embedding_of) {
    for (int y = 0; y < cells_; ++y) {
      for (int x = 0; x < cells_; ++x) {
        const Vec2 middle((x + 0.5) * cell_px_ - 0.5, (y + 0.5) * cell_px_ - 0.5);
        margins_[static_cast<std::size_t>(y * cells_ + x)] = byte(margin_of(middle));
        for (int c = 0; c < kDrawnEmbedding; ++c)
          embedding_[static_cast<std::size_t>((y * cells_ + x) * kDrawnEmbedding + c)] =
              byte(embedding_of(middle, c));
      }
    }
  }

  PictureReading view() const {
    PictureReading reading;
    reading.margins = {margins_.data(), cells_, cells_};
    reading.margin_step = kUnit;
    reading.embedding = {embedding_.data(), cells_ * kDrawnEmbedding, cells_};
    reading.embedding_size = kDrawnEmbedding;
    reading.embedding_step = kUnit;
    reading.network_width = reading.network_height = cells_;
    reading.place = {0, 0, cells_, cells_};
    reading.frame_width = reading.frame_height = cells_ * cell_px_;
    return reading;
  }

 private:
  static constexpr float kUnit = 1.0F / 32.0F;

  static std::int8_t byte(double value) {
    return static_cast<std::int8_t>(
        std::lround(std::clamp(value / static_cast<double>(kUnit), -128.0, 127.0)));
  }

  int cells_;
  int cell_px_;
  std::vector<std::int8_t> margins_;
  std::vector<std::int8_t> embedding_;
};

}  // namespace traygauge::test
