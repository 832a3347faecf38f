// Labels that nobody drew, against the given ones. The captures named are those that the parameters were not
// tuned on, and some of those that they were.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "firmware/measure/capture_session.hpp"
#include "firmware/segment/label_scores.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

struct Expected {
  const char* capture;
  double card_iou;
  double axes_error;
  double food_iou;
  double item_iou;
  bool has_right_count;
};

// A little below what is reached.
constexpr std::array kExpected = {
    Expected{"meals/m01", 0.99, 0.01, 0.96, 0.96, true},
    Expected{"meals/m04", 0.99, 0.01, 0.95, 0.92, true},
    Expected{"meals/m06", 0.99, 0.01, 0.95, 0.95, true},  // the network denies an egg's white
    Expected{"meals/m08", 0.99, 0.01, 0.96, 0.95, true},
    Expected{"angles/a01", 0.99, 0.01, 0.91, 0.90, true},
    Expected{"plates/c1_oval", 0.99, 0.01, 0.94, 0.94, true},
    Expected{"plates/c1_soup", 0.99, 0.01, 0.97, 0.97, true},
    Expected{"meals/m11", 0.99, 0.01, 0.98, 0.96, true},
    Expected{"trays/t01", 0.99, 0.015, 0.97, 0.96, true},
    Expected{"trays/t04", 0.99, 0.01, 0.95, 0.94, true},  // white yoghurt in a white bowl
    Expected{"trays/t05", 0.99, 0.01, 0.94, 0.92, true},  // a cake's top and side
};

class SegmentedCaptures : public testing::TestWithParam<Expected> {};
INSTANTIATE_TEST_SUITE_P(All, SegmentedCaptures, testing::ValuesIn(kExpected), [](const auto& param) {
  std::string name = param.param.capture;
  return name.substr(name.rfind('/') + 1);
});

TEST_P(SegmentedCaptures, LabelsAgreeWithTheGivenOnes) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const Expected& expected = GetParam();
  const Capture capture = read_capture(captures_folder() / expected.capture);
  CaptureSession session(capture, capture.pairs.front(), capture.dishes, {}, LabelSource::automatic);
  ASSERT_TRUE(session.drawn()->segmentation.status.ok());
  for (std::size_t v = 0; v < 2; ++v) {
    const LabelScores scores = score_labels(session.drawn()->labels[v], session.given_labels()[v]);
    std::printf("%s view %zu: food %.3f items %.3f card %.4f\n", expected.capture, v, scores.food_iou,
                scores.mean_item_iou(), scores.card_iou);
    EXPECT_GE(scores.card_iou, expected.card_iou);
    EXPECT_GE(scores.food_iou, expected.food_iou);
    EXPECT_GE(scores.mean_item_iou(), expected.item_iou);
    EXPECT_EQ(scores.has_right_count(), expected.has_right_count);
    for (const DishScore& dish : scores.dishes) EXPECT_LE(dish.axes_error, expected.axes_error);
  }
  // Whatever the labels, the measurement takes them as it takes given ones.
  const Measurement& measurement = session.measure(1);
  EXPECT_TRUE(measurement.status.ok()) << name(measurement.status.code());
  EXPECT_EQ(static_cast<int>(measurement.items.size()), session.drawn()->segmentation.items);
}

// The first view twice: without a baseline there is no height, and colour has to do. The labels of both are
// the same but for the borders between items, which the second view gets from the first.
TEST(SegmentedCapture, SameViewsGetTheSameLabels) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const Capture capture = read_capture(captures_folder() / "meals/m01");
  const CaptureSession session(capture, {0, 0}, capture.dishes, {}, LabelSource::automatic);
  const PairLabels& drawn = *session.drawn();
  ASSERT_TRUE(drawn.segmentation.status.ok());
  const LabelScores scores = score_labels(drawn.labels[0], drawn.labels[1]);
  EXPECT_EQ(scores.card_iou, 1.0);
  EXPECT_GT(scores.food_iou, 0.999);
  EXPECT_GT(scores.mean_item_iou(), 0.92);
}

// Its print is 130 px long, blurred and noisy.
TEST(SegmentedCapture, ASmallBlurredCardIsFound) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const Capture capture = read_capture(captures_folder() / "trays/t04");
  const CaptureSession session(capture, {0, 2}, capture.dishes, {}, LabelSource::automatic);
  ASSERT_TRUE(session.drawn()->segmentation.status.ok());
  for (std::size_t v = 0; v < 2; ++v)
    EXPECT_GE(score_labels(session.drawn()->labels[v], session.given_labels()[v]).card_iou, 0.98) << v;
}

}  // namespace
}  // namespace traygauge
