// A pair in reverse order is valid and measures the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "firmware/measure/capture_session.hpp"
#include "tests/captures/single_dish_captures.hpp"

namespace traygauge {
namespace {

constexpr double kMaxDifference = 0.02;

std::map<int, double> volumes_of(Profile profile, const Capture& capture, std::array<int, 2> pair) {
  ProfileParameters parameters;
  parameters.profile = profile;
  CaptureSession session(capture, pair, capture.dishes, parameters);
  const Measurement& measurement = session.measure(1);
  EXPECT_TRUE(measurement.status.ok()) << pair[0] << "," << pair[1] << " " << name(measurement.status.code());
  std::map<int, double> volumes;
  for (const ItemResult& item : measurement.items) volumes[item.label] = item.volume_ml;
  return volumes;
}

class ViewOrderOfCaptures : public testing::TestWithParam<Profile> {};
INSTANTIATE_TEST_SUITE_P(Both, ViewOrderOfCaptures, testing::Values(Profile::best, Profile::paper),
                         [](const auto& profile) {
                           return profile.param == Profile::best ? "Best" : "Paper";
                         });

TEST_P(ViewOrderOfCaptures, ReversedPairsMeasureTheSame) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  double largest = 0.0;
  for (const auto& [folder, capture, pair] : single_dish_pairs(GetParam())) {
    const auto forward = volumes_of(GetParam(), capture, pair);
    const auto reverse = volumes_of(GetParam(), capture, {pair[1], pair[0]});
    ASSERT_EQ(forward.size(), reverse.size());
    for (const auto& [label, volume_ml] : forward) {
      const double difference = std::abs(reverse.at(label) / volume_ml - 1.0);
      EXPECT_LE(difference, kMaxDifference) << folder.filename() << " item " << label;
      largest = std::max(largest, difference);
    }
  }
  std::printf("largest difference %.4f %%\n", 100.0 * largest);
}

}  // namespace
}  // namespace traygauge
