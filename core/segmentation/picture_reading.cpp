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

// Reads numbers of cells, `channels` side by side, at a pixel of the frame.
class CellReader {
 public:
  CellReader(const PictureReading& reading, const Vec2& pixel, ImageView<const std::int8_t> cells,
             int channels)
      : cells_(cells),
        channels_(channels),
        x_(pixel.x(), reading.frame_width, reading.place.left, reading.place.width, reading.network_width,
           cells.width / channels),
        y_(pixel.y(), reading.frame_height, reading.place.top, reading.place.height, reading.network_height,
           cells.height) {}

  float value(int channel) const {
    return (1.0F - y_.part) * along(y_.first, channel) + y_.part * along(y_.first + 1, channel);
  }

 private:
  float along(int row, int channel) const {
    const auto at = [&](int column) {
      return static_cast<float>(cells_.at(column * channels_ + channel, row));
    };
    return (1.0F - x_.part) * at(x_.first) + x_.part * at(x_.first + 1);
  }

  ImageView<const std::int8_t> cells_;
  int channels_;
  CellPosition x_;
  CellPosition y_;
};

int food_class(const Network& network) {
  const auto names = std::span(network.classes).first(network.class_count);
  return static_cast<int>(std::find(names.begin(), names.end(), kFoodClass) - names.begin());
}

// Halved, so that a difference of two bytes is one.
void write_margins(const TensorView& logits, int food, std::span<std::int8_t> margins) {
  std::size_t cell = 0;
  for (int y = 0; y < logits.shape.height; ++y) {
    for (int x = 0; x < logits.shape.width; ++x) {
      int other = -128;
      for (int c = 0; c < logits.shape.channels; ++c) {
        if (c != food) other = std::max(other, logits.at(x, y, c));
      }
      margins[cell++] = static_cast<std::int8_t>((logits.at(x, y, food) - other) / 2);
    }
  }
}

bool has_room(const TensorShape& cells) {
  return std::min(cells.width, cells.height) > 1;
}

}  // namespace

bool reads_food(const Network& network) {
  const NetworkLayer& classes = *network.find(NetworkRole::classes);  // every network has it
  const NetworkLayer* embedding = network.find(NetworkRole::embedding);
  return food_class(network) < classes.output.channels && classes.output.channels > 1 &&
         has_room(classes.output) && embedding != nullptr &&
         embedding->output.channels <= static_cast<int>(kMaxEmbedding) && has_room(embedding->output);
}

float PictureReading::margin_at(const Vec2& pixel) const {
  return margin_step * CellReader(*this, pixel, margins, 1).value(0);
}

Vec2 PictureReading::pixel_of(double x, double y) const {
  const auto along = [](double cell, int frame, int begin, int covered, int network, int cells) {
    const double in_network = (cell + 0.5) * network / cells;
    return (in_network - begin) * frame / covered - 0.5;
  };
  return {along(x, frame_width, place.left, place.width, network_width, margins.width),
          along(y, frame_height, place.top, place.height, network_height, margins.height)};
}

Embedding PictureReading::embedding_at(const Vec2& pixel) const {
  const CellReader reader(*this, pixel, embedding, embedding_size);
  Embedding values{};
  for (int c = 0; c < embedding_size; ++c)
    values[static_cast<std::size_t>(c)] = embedding_step * reader.value(c);
  return values;
}

PictureReading read_picture(const FrameView& frame, const Network& network, NetworkRunner& runner,
                            const PictureReadingStorage& storage) {
  assert(reads_food(network));
  PictureReading reading;
  reading.place = fill_input(frame, runner.input());
  runner.run();
  const TensorView logits = runner.output(NetworkRole::classes);
  write_margins(logits, food_class(network), storage.margins);
  reading.margins = {storage.margins.data(), logits.shape.width, logits.shape.height};
  reading.margin_step = 2.0F * runner.step(NetworkRole::classes);
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
