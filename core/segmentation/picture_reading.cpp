#include "core/segmentation/picture_reading.hpp"

#include <algorithm>
#include <cassert>
#include <string_view>

namespace traygauge {
namespace {

constexpr std::string_view kFoodClass = "food";

// Between which cells a pixel of the frame lies, along one axis.
struct CellPosition {
  int first = 0;
  float part = 0.0F;  // of the way to the next

  CellPosition(double pixel, int frame, int begin, int covered, int network, int cells) {
    const double in_network = begin + (pixel + 0.5) * covered / frame;
    const double cell = std::clamp(in_network * cells / network - 0.5, 0.0, cells - 1.0);
    first = std::min(static_cast<int>(cell), std::max(0, cells - 2));
    part = static_cast<float>(cell - first);
  }
};

}  // namespace

bool reads_food(const Network& network) {
  const auto names = std::span(network.classes).first(network.class_count);
  const NetworkLayer* embedding = network.find(NetworkRole::embedding);
  return std::find(names.begin(), names.end(), kFoodClass) != names.end() && embedding != nullptr &&
         embedding->output.channels <= static_cast<int>(kMaxEmbedding) &&
         std::min(embedding->output.width, embedding->output.height) > 1;
}

Embedding PictureReading::embedding_at(const Vec2& pixel) const {
  const CellPosition x(pixel.x(), frame_width, place.left, place.width, network_width,
                       embedding.width / embedding_size);
  const CellPosition y(pixel.y(), frame_height, place.top, place.height, network_height, embedding.height);
  Embedding values{};
  for (int c = 0; c < embedding_size; ++c) {
    const auto along = [&](int row) {
      const auto at = [&](int column) {
        return static_cast<float>(embedding.at(column * embedding_size + c, row));
      };
      return (1.0F - x.part) * at(x.first) + x.part * at(x.first + 1);
    };
    values[static_cast<std::size_t>(c)] =
        embedding_step * ((1.0F - y.part) * along(y.first) + y.part * along(y.first + 1));
  }
  return values;
}

PictureReading read_picture(const FrameView& frame, const Network& network, NetworkRunner& runner,
                            const PictureReadingStorage& storage) {
  assert(reads_food(network));
  PictureReading reading;
  reading.place = fill_input(frame, runner.input());
  runner.run();
  const TensorView embedding = runner.output(NetworkRole::embedding);
  for (std::size_t i = 0; i < embedding.shape.bytes(); ++i)
    storage.embedding[i] = static_cast<std::int8_t>(embedding.data[i]);
  reading.embedding_size = embedding.shape.channels;
  reading.embedding = {storage.embedding.data(), embedding.shape.width * embedding.shape.channels,
                       embedding.shape.height};
  reading.embedding_step = runner.step(NetworkRole::embedding);
  reading.frame_width = frame.width;
  reading.frame_height = frame.height;
  reading.network_width = network.width;
  reading.network_height = network.height;
  return reading;
}

}  // namespace traygauge
