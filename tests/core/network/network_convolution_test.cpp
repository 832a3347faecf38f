// Single layers against OpenCV, which computes the same in floats.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/core/network/running_network.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

std::vector<std::uint8_t> draw_picture(std::mt19937& random, int width, int height) {
  std::vector<std::uint8_t> picture(static_cast<std::size_t>(kPictureChannels * width * height));
  std::uniform_int_distribution<int> byte(0, 255);
  for (std::uint8_t& value : picture) value = static_cast<std::uint8_t>(byte(random));
  return picture;
}

void set_scale(ComposedLayer& layer, int shift) {
  const auto channels = static_cast<std::size_t>(layer.channels);
  layer.biases.assign(channels, 0);
  layer.multipliers.assign(channels, std::int32_t{1} << 20U);
  layer.shifts.assign(channels, static_cast<std::uint8_t>(20 + shift));
}

// A network of one layer that shows the whole of it.
ComposedNetwork single_layer(int width, int height, int kernel, int stride, int channels) {
  ComposedNetwork network;
  network.width = width;
  network.height = height;
  network.classes.assign(static_cast<std::size_t>(channels), "one");
  network.layers.push_back({kernel, stride, false, NetworkRole::classes, {{0}}, channels});
  return network;
}

// What OpenCV makes of the layer, halved `shift` times and rounded.
cv::Mat1d filter(const ComposedLayer& layer, int channel, const std::vector<cv::Mat1d>& inputs) {
  cv::Mat1d sum(inputs[0].size(), 0.0);
  const int kernel = layer.kernel;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    cv::Mat1d weights(kernel, kernel);
    for (int i = 0; i < kernel * kernel; ++i) {
      const std::size_t at = static_cast<std::size_t>(channel * kernel * kernel + i) * inputs.size() + k;
      weights(i / kernel, i % kernel) = layer.weights[at];
    }
    cv::Mat1d filtered;
    cv::filter2D(inputs[k], filtered, CV_64F, weights, {-1, -1}, 0.0, cv::BORDER_CONSTANT);
    sum += filtered;
  }
  return sum;
}

std::vector<cv::Mat1d> channels_of(const std::vector<std::uint8_t>& picture, int width, int height) {
  const cv::Mat3b bytes(height, width,
                        reinterpret_cast<cv::Vec3b*>(const_cast<std::uint8_t*>(picture.data())));
  std::vector<cv::Mat1d> channels(kPictureChannels);
  for (int c = 0; c < kPictureChannels; ++c) {
    cv::Mat1b channel;
    cv::extractChannel(bytes, channel, c);
    channel.convertTo(channels[static_cast<std::size_t>(c)], CV_64F);
  }
  return channels;
}

TEST(NetworkConvolution, IsOpenCvsFilterRounded) {
  std::mt19937 random(random_seed());
  for (const int kernel : {1, 3}) {
    for (const int stride : {1, 2}) {
      constexpr int kWidth = 37;
      constexpr int kHeight = 22;
      constexpr int kShift = 8;
      ComposedNetwork network = single_layer(kWidth, kHeight, kernel, stride, 5);
      ComposedLayer& layer = network.layers[0];
      set_scale(layer, kShift);
      std::uniform_int_distribution<int> weight(-20, 20);
      layer.weights.resize(static_cast<std::size_t>(5 * kernel * kernel * kPictureChannels));
      for (std::int8_t& value : layer.weights) value = static_cast<std::int8_t>(weight(random));
      const std::vector<std::uint8_t> picture = draw_picture(random, kWidth, kHeight);
      RunningNetwork running(network);
      running.run(picture);
      const TensorView output = running.runner().output(NetworkRole::classes);
      ASSERT_EQ(output.shape,
                (TensorShape{(kWidth + stride - 1) / stride, (kHeight + stride - 1) / stride, 5}));
      for (int c = 0; c < 5; ++c) {
        const cv::Mat1d sums = filter(layer, c, channels_of(picture, kWidth, kHeight));
        for (int y = 0; y < output.shape.height; ++y) {
          for (int x = 0; x < output.shape.width; ++x) {
            const double real = std::ldexp(sums(y * stride, x * stride), -kShift);
            ASSERT_EQ(output.at(x, y, c), std::clamp(std::floor(real + 0.5), -128.0, 127.0))
                << kernel << "x" << kernel << " stride " << stride << " at " << x << ", " << y << ", " << c;
          }
        }
      }
    }
  }
}

// The picture halved by one layer and enlarged by the next, both with one weight of 1 a channel. The picture
// differs by odd sides, which are cut off again.
cv::Mat enlarge_by_network(Enlargement enlargement, const std::vector<std::uint8_t>& picture, int width,
                           int height, cv::Mat3b& small) {
  ComposedNetwork network = single_layer(width, height, 1, 2, kPictureChannels);
  network.layers[0] = {1, 2, true, NetworkRole::none, {{0}}, kPictureChannels};
  network.layers.push_back({1, 1, true, NetworkRole::classes, {{1, enlargement}, {0}}, kPictureChannels});
  for (ComposedLayer& layer : network.layers) {
    set_scale(layer, 0);
    const int inputs = kPictureChannels * static_cast<int>(layer.sources.size());
    layer.weights.assign(static_cast<std::size_t>(kPictureChannels * inputs), 0);
    for (int c = 0; c < kPictureChannels; ++c) layer.weights[static_cast<std::size_t>(c * inputs + c)] = 1;
  }
  RunningNetwork running(network);
  running.run(picture);
  small = cv::Mat3b((height + 1) / 2, (width + 1) / 2);
  for (int y = 0; y < small.rows; ++y) {
    for (int x = 0; x < small.cols; ++x) {
      for (int c = 0; c < kPictureChannels; ++c) {
        small(y, x)[c] = picture[static_cast<std::size_t>((2 * y * width + 2 * x) * kPictureChannels + c)];
      }
    }
  }
  const TensorView output = running.runner().output(NetworkRole::classes);
  return cv::Mat(output.shape.height, output.shape.width, CV_8UC3, const_cast<std::uint8_t*>(output.data))
      .clone();
}

TEST(NetworkConvolution, EnlargesAsOpenCvsResize) {
  std::mt19937 random(random_seed());
  for (const int width : {40, 41}) {
    constexpr int kHeight = 23;
    const std::vector<std::uint8_t> picture = draw_picture(random, width, kHeight);
    cv::Mat3b small;
    const cv::Mat nearest = enlarge_by_network(Enlargement::nearest, picture, width, kHeight, small);
    cv::Mat expected;
    cv::resize(small, expected, {}, 2.0, 2.0, cv::INTER_NEAREST);
    const cv::Rect whole(0, 0, width, kHeight);
    EXPECT_EQ(cv::norm(nearest, expected(whole), cv::NORM_INF), 0.0) << width;

    const cv::Mat bilinear = enlarge_by_network(Enlargement::bilinear, picture, width, kHeight, small);
    cv::Mat3f real;
    cv::Mat3f small_real;
    small.convertTo(small_real, CV_32F);
    cv::resize(small_real, real, {}, 2.0, 2.0, cv::INTER_LINEAR);
    // Sixteenths are exact in a float; the nearest byte is at most a half away.
    cv::Mat3f made;
    bilinear.convertTo(made, CV_32F);
    EXPECT_LE(cv::norm(made, real(whole), cv::NORM_INF), 0.5) << width;
  }
}

TEST(NetworkConvolution, ReluCutsOffWhatIsNegative) {
  ComposedNetwork network = single_layer(16, 16, 1, 1, 2);
  network.layers[0].has_relu = true;
  set_scale(network.layers[0], 0);
  network.layers[0].biases = {-100, 0};
  network.layers[0].weights = {1, 0, 0, -1, 0, 0};
  RunningNetwork running(network);
  std::vector<std::uint8_t> picture(16 * 16 * 3, 150);
  picture[0] = 60;
  running.run(picture);
  const TensorView output = running.runner().output(NetworkRole::classes);
  EXPECT_EQ(output.at(0, 0, 0), 0);
  EXPECT_EQ(output.at(1, 0, 0), 50);
  EXPECT_EQ(output.at(1, 0, 1), 0);
}

}  // namespace
}  // namespace traygauge::test
