// What the network for food reads in one view: how much each place looks like food, and numbers that are
// alike within portions of one food.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/network/network.hpp"
#include "core/network/network_input.hpp"
#include "core/network/network_runner.hpp"

namespace traygauge {

inline constexpr std::size_t kMaxEmbedding = 16;     // numbers a cell; config/network/food.tgn has 12
using Embedding = std::array<float, kMaxEmbedding>;  // those beyond the network's are 0

// Cells are the network's; of the embedding, their numbers lie side by side.
struct PictureReading {
  ImageView<const std::int8_t> margins;  // food's logit less the largest other one
  ImageView<const std::int8_t> embedding;
  int embedding_size = 0;
  float margin_step = 0.0F;  // the real value of one unit
  float embedding_step = 0.0F;
  InputPlacement place;  // of the frame in the network's picture
  int frame_width = 0;
  int frame_height = 0;
  int network_width = 0;
  int network_height = 0;

  // Linear between cells; of the nearest where the pixel lies beyond.
  float margin_at(const Vec2& pixel) const;
  Embedding embedding_at(const Vec2& pixel) const;
  // The middle of a cell of `margins` in the frame.
  Vec2 pixel_of(double x, double y) const;
};

// Whether a network is one for food: a class `food` and another, and an embedding of at most kMaxEmbedding
// numbers.
bool reads_food(const Network& network);

struct PictureReadingStorage {
  std::span<std::int8_t> margins;
  std::span<std::int8_t> embedding;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Network& network) {
    const TensorShape classes = network.find(NetworkRole::classes)->output;
    margins = arena.template take<std::int8_t>(static_cast<std::size_t>(classes.width) *
                                               static_cast<std::size_t>(classes.height));
    embedding = arena.template take<std::int8_t>(network.find(NetworkRole::embedding)->output.bytes());
  }
};

// Runs the network, for which reads_food() holds, on the frame.
PictureReading read_picture(const FrameView& frame, const Network& network, NetworkRunner& runner,
                            const PictureReadingStorage& storage);

}  // namespace traygauge
