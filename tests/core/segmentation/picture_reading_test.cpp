// What is read in a picture, against the network's own outputs.
#include "core/segmentation/picture_reading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "tests/core/network/running_network.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr int kNetworkWidth = 64;
constexpr int kNetworkHeight = 48;

struct ReadFrame {
  ReadFrame(int columns, int rows)
      : width(columns), height(rows), pixels(std::size_t{3} * static_cast<std::size_t>(columns * rows)) {
    std::mt19937 random(test::random_seed());
    for (std::uint8_t& value : pixels) value = static_cast<std::uint8_t>(random());
    composed = test::food_layers(kNetworkWidth, kNetworkHeight);
    test::draw_numbers(static_cast<std::uint32_t>(random()), composed);
    if (std::find(composed.classes.begin(), composed.classes.end(), "food") == composed.classes.end())
      composed.classes[2] = "food";
  }
  FrameView frame() const { return {pixels.data(), width, height, 3 * width, PixelFormat::rgb8}; }

  int width;
  int height;
  std::vector<std::uint8_t> pixels;
  test::ComposedNetwork composed;
};

// The middle of a cell in the frame, for an output whose cells have `side` of the network's pixels.
Vec2 middle_of(const PictureReading& reading, int x, int y, int side) {
  const InputPlacement& place = reading.place;
  return {((x + 0.5) * side - place.left) * reading.frame_width / place.width - 0.5,
          ((y + 0.5) * side - place.top) * reading.frame_height / place.height - 0.5};
}

// Differences of logits are halved where they are kept.
void expect_margins(const PictureReading& reading, const NetworkRunner& runner, const Network& network) {
  const TensorView logits = runner.output(NetworkRole::classes);
  const auto names = std::span(network.classes).first(network.class_count);
  const auto food = static_cast<int>(std::find(names.begin(), names.end(), "food") - names.begin());
  const float step = runner.step(NetworkRole::classes);
  for (int y = 0; y < logits.shape.height; ++y) {
    for (int x = 0; x < logits.shape.width; ++x) {
      int other = std::numeric_limits<int>::min();
      for (int c = 0; c < logits.shape.channels; ++c)
        other = c == food ? other : std::max(other, logits.at(x, y, c));
      const auto margin = static_cast<float>(logits.at(x, y, food) - other);
      ASSERT_NEAR(reading.margin_at(middle_of(reading, x, y, kNetworkWidth / logits.shape.width)),
                  step * margin, 1.01F * step);
    }
  }
}

TEST(PictureReading, IsWhatTheNetworkGives) {
  for (const auto& [width, height] : {std::pair{160, 120}, {200, 100}, {90, 150}}) {
    SCOPED_TRACE(width);
    const ReadFrame read(width, height);
    test::RunningNetwork running(read.composed);
    const Network& network = running.network();
    ASSERT_TRUE(reads_food(network));
    test::Allocated<PictureReadingStorage> storage{network};
    const PictureReading reading = read_picture(read.frame(), network, running.runner(), *storage);
    fill_input(read.frame(), running.runner().input());
    running.runner().run();
    expect_margins(reading, running.runner(), network);
    const TensorView embedding = running.runner().output(NetworkRole::embedding);
    const int coarse = kNetworkWidth / embedding.shape.width;
    for (int y = 0; y < embedding.shape.height; ++y) {
      for (int x = 0; x < embedding.shape.width; ++x) {
        const Embedding values = reading.embedding_at(middle_of(reading, x, y, coarse));
        for (int c = 0; c < embedding.shape.channels; ++c) {
          ASSERT_NEAR(
              values[static_cast<std::size_t>(c)],
              running.runner().step(NetworkRole::embedding) * static_cast<float>(embedding.at(x, y, c)),
              1e-3F);
        }
      }
    }
  }
}

TEST(PictureReading, IsLinearBetweenCellsAndEndsWithThem) {
  const ReadFrame read(160, 120);
  test::RunningNetwork running(read.composed);
  test::Allocated<PictureReadingStorage> storage{running.network()};
  const PictureReading reading = read_picture(read.frame(), running.network(), running.runner(), *storage);
  const int side = kNetworkWidth / running.runner().output(NetworkRole::embedding).shape.width;
  const Vec2 a = middle_of(reading, 10, 7, side);
  const Vec2 b = middle_of(reading, 11, 7, side);
  const Embedding between = reading.embedding_at(0.75 * a + 0.25 * b);
  for (std::size_t c = 0; c < kMaxEmbedding; ++c) {
    EXPECT_NEAR(between[c], 0.75F * reading.embedding_at(a)[c] + 0.25F * reading.embedding_at(b)[c], 1e-4F)
        << c;
  }
  EXPECT_EQ(reading.margin_at({-50.0, -20.0}), reading.margin_at({0.0, 0.0}));
  EXPECT_EQ(reading.embedding_at({-50.0, -20.0}), reading.embedding_at({0.0, 0.0}));
  EXPECT_EQ(reading.embedding_at({500.0, 400.0}), reading.embedding_at({159.0, 119.0}));
}

// Tensor 0 is the picture; the next is the first layer's.
void take_out(NetworkRole role, test::ComposedNetwork& network) {
  const auto out = std::find_if(network.layers.begin(), network.layers.end(),
                                [&](const test::ComposedLayer& layer) { return layer.role == role; });
  const auto tensor = static_cast<int>(out - network.layers.begin()) + 1;
  network.layers.erase(out);
  for (test::ComposedLayer& layer : network.layers) {
    for (test::ComposedSource& source : layer.sources) source.tensor -= source.tensor > tensor ? 1 : 0;
  }
}

TEST(PictureReading, NetworksForSomethingElseAreTold) {
  const ReadFrame read(160, 120);
  const auto reads = [&](auto spoil) {
    test::ComposedNetwork composed = read.composed;
    spoil(composed);
    return reads_food(test::RunningNetwork(composed).network());
  };
  EXPECT_TRUE(reads([](test::ComposedNetwork&) {}));
  EXPECT_FALSE(reads([](test::ComposedNetwork& n) {
    for (std::string& name : n.classes) name = name == "food" ? "fruit" : name;
  }));
  EXPECT_TRUE(reads([](test::ComposedNetwork& n) { take_out(NetworkRole::border, n); }));
  EXPECT_FALSE(reads([](test::ComposedNetwork& n) { take_out(NetworkRole::embedding, n); }));
}

}  // namespace
}  // namespace traygauge
