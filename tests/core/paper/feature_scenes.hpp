// Random descriptor sets with known partners.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "core/paper/features/keypoint.hpp"

namespace traygauge::paper {

struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;

  FeatureSet view() const { return {keypoints, descriptors}; }
  cv::Mat mat() const {
    cv::Mat rows(static_cast<int>(descriptors.size()), kDescriptorLength, CV_32F);
    for (int i = 0; i < rows.rows; ++i) {
      const Descriptor& descriptor = descriptors[static_cast<std::size_t>(i)];
      std::copy(descriptor.begin(), descriptor.end(), rows.ptr<float>(i));
    }
    return rows;
  }
};

inline void normalise(Descriptor& descriptor) {
  float square = 0.0F;
  for (const float value : descriptor) square += value * value;
  for (float& value : descriptor) value /= std::sqrt(square);
}

inline Descriptor random_descriptor(std::mt19937& random) {
  std::normal_distribution<float> gauss;
  Descriptor descriptor{};
  for (float& value : descriptor) value = gauss(random);
  normalise(descriptor);
  return descriptor;
}

inline std::int8_t random_sign(std::mt19937& random, bool with_zero) {
  if (with_zero) return static_cast<std::int8_t>(static_cast<int>(random() % 3) - 1);
  return random() % 2 == 0 ? std::int8_t{-1} : std::int8_t{1};
}

// `shared` features of `second` are noisy copies of features of `first`, in another order; the rest is
// random.
inline void make_pair(std::mt19937& random, std::size_t first_count, std::size_t second_count,
                      std::size_t shared, float noise, bool with_zero, Features& first, Features& second) {
  first = {};
  second = {};
  for (std::size_t i = 0; i < first_count; ++i) {
    first.descriptors.push_back(random_descriptor(random));
    first.keypoints.push_back({.laplacian = random_sign(random, with_zero)});
  }
  std::normal_distribution<float> gauss(0.0F, noise);
  std::vector<std::size_t> order(second_count);
  for (std::size_t i = 0; i < second_count; ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  second.descriptors.resize(second_count);
  second.keypoints.resize(second_count);
  for (std::size_t i = 0; i < second_count; ++i) {
    Descriptor descriptor = i < shared ? first.descriptors[i] : random_descriptor(random);
    if (i < shared) {
      for (float& value : descriptor) value += gauss(random);
    }
    normalise(descriptor);
    second.descriptors[order[i]] = descriptor;
    second.keypoints[order[i]].laplacian =
        i < shared ? first.keypoints[i].laplacian : random_sign(random, with_zero);
  }
}

}  // namespace traygauge::paper
