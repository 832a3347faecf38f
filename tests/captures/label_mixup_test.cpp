// Outlines of the wrong view must never pass with a volume, however near the views lie to each other.
#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/measure/capture_session.hpp"
#include "tests/captures/single_dish_captures.hpp"

namespace traygauge {
namespace {

// A session whose views carry the labels of these views.
StatusCode measure_with_labels(Profile profile, const Capture& original, std::array<int, 2> pair,
                               std::array<int, 2> labels, std::size_t& items) {
  Capture capture = original;
  for (std::size_t i = 0; i < 2; ++i) {
    capture.views[static_cast<std::size_t>(pair[i])].labels =
        original.views[static_cast<std::size_t>(labels[i])].labels;
  }
  ProfileParameters parameters;
  parameters.profile = profile;
  CaptureSession session(capture, pair, capture.dishes, parameters);
  const Measurement& measurement = session.measure(1);
  const auto measured = [](const ItemResult& item) { return item.status == StatusCode::ok; };
  items =
      static_cast<std::size_t>(std::count_if(measurement.items.begin(), measurement.items.end(), measured));
  return measurement.status.code();
}

class LabelMixup : public testing::TestWithParam<Profile> {};
INSTANTIATE_TEST_SUITE_P(Both, LabelMixup, testing::Values(Profile::best, Profile::paper),
                         [](const auto& profile) {
                           return profile.param == Profile::best ? "Best" : "Paper";
                         });

TEST_P(LabelMixup, ExchangedOrDoubledLabelsAreRefused) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const std::vector<NamedPair> pairs = single_dish_pairs(GetParam());
  EXPECT_GE(pairs.size(), GetParam() == Profile::best ? 20U : 7U);
  for (const auto& [folder, capture, pair] : pairs) {
    for (const auto& labels : {std::array{pair[1], pair[0]}, {pair[0], pair[0]}, {pair[1], pair[1]}}) {
      std::size_t items = 0;
      const StatusCode code = measure_with_labels(GetParam(), capture, pair, labels, items);
      EXPECT_EQ(items, 0U) << folder.filename() << " " << pair[0] << "," << pair[1] << " labels " << labels[0]
                           << "," << labels[1] << ": " << name(code);
      EXPECT_TRUE(code == StatusCode::labels_inconsistent || code == StatusCode::card_not_found ||
                  code == StatusCode::pose_contradicts_card || code == StatusCode::dish_unknown ||
                  code == StatusCode::table_not_found)
          << name(code);
    }
  }
}

// The neighbour's labels on the circle of views are the hardest to tell: 5 degrees off.
TEST_P(LabelMixup, TheNeighboursLabelsAreRefused) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const Capture capture = read_capture(captures_folder() / "angles" / "a01");
  for (int view = 1; view <= 7; ++view) {
    for (const int neighbour : {view - 1, view + 1}) {
      if (neighbour < 1 || neighbour > 7) continue;
      std::size_t items = 0;
      const StatusCode code = measure_with_labels(GetParam(), capture, {0, view}, {0, neighbour}, items);
      EXPECT_TRUE(code == StatusCode::labels_inconsistent || code == StatusCode::dish_unknown)
          << view << " with " << neighbour << ": " << name(code);
      EXPECT_EQ(items, 0U);
    }
  }
}

}  // namespace
}  // namespace traygauge
