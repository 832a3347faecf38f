// What is asked of views before their pixels are looked at.
#include "core/quality/view_input.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

TEST(ViewInput, SizesMustBeThoseOfLensMemoryAndLabels) {
  const cv::Mat3b picture(120, 160, cv::Vec3b(1, 2, 3));
  const cv::Mat1b labels(120, 160, std::uint8_t{0});
  LensModel lens;
  lens.width = 160;
  lens.height = 120;
  const FrameLimits roomy{160, 120};
  const auto check = [&](const FrameView& frame, const cv::Mat1b& own, const FrameLimits& limits) {
    return check_sizes(frame, test::view_of(own), lens, limits).code();
  };
  EXPECT_EQ(check(test::frame_of(picture), labels, roomy), StatusCode::ok);
  EXPECT_EQ(check({}, labels, roomy), StatusCode::frame_missing);
  EXPECT_EQ(check(test::frame_of(picture), labels, {159, 120}), StatusCode::frame_size_mismatch);
  EXPECT_EQ(check(test::frame_of(picture), labels, {160, 119}), StatusCode::frame_size_mismatch);
  EXPECT_EQ(check(test::frame_of(picture), cv::Mat1b(120, 159), roomy), StatusCode::labels_size_mismatch);
  EXPECT_EQ(check(test::frame_of(picture), cv::Mat1b(121, 160), roomy), StatusCode::labels_size_mismatch);
  EXPECT_EQ(check(test::frame_of(picture), cv::Mat1b(), roomy), StatusCode::labels_size_mismatch);
  lens.height = 119;
  EXPECT_EQ(check(test::frame_of(picture), labels, roomy), StatusCode::frame_size_mismatch);
}

TEST(ViewInput, LabelsMustShowFoodOnAWholeDish) {
  const auto check = [](int dish, const cv::Rect& where, int item) {
    cv::Mat1b labels(100, 100, kBackgroundLabel);
    labels(where).setTo(dish);
    if (item > 0) labels(cv::Rect(45, 45, 10, 10)).setTo(item);
    return check_labels(measure_regions(test::view_of(labels))).code();
  };
  const cv::Rect middle(20, 20, 60, 60);
  EXPECT_EQ(check(kDishLabel, middle, 2), StatusCode::ok);
  EXPECT_EQ(check(201, middle, 199), StatusCode::ok);
  EXPECT_EQ(check(kDishLabel, middle, 0), StatusCode::no_food_label);
  EXPECT_EQ(check(kBackgroundLabel, middle, 0), StatusCode::no_dish_label);
  EXPECT_EQ(check(kCardLabel, middle, 0), StatusCode::no_dish_label);
  for (const cv::Rect& at :
       {cv::Rect(0, 20, 60, 60), cv::Rect(20, 0, 60, 60), cv::Rect(40, 20, 60, 60), cv::Rect(20, 40, 60, 60)})
    EXPECT_EQ(check(kDishLabel, at, 2), StatusCode::dish_cut_off);
}

// A card at the picture's edge is not the dish's concern.
TEST(ViewInput, ACardAtTheEdgeCutsOffNoDish) {
  cv::Mat1b labels(100, 100, kBackgroundLabel);
  labels(cv::Rect(20, 20, 60, 60)).setTo(kDishLabel);
  labels(cv::Rect(40, 40, 10, 10)).setTo(5);
  labels(cv::Rect(0, 0, 15, 15)).setTo(kCardLabel);
  EXPECT_TRUE(check_labels(measure_regions(test::view_of(labels))).ok());
}

TEST(ViewInput, AnglesAreRefusedBeyondAndWarnedOfBeforeTheirLimits) {
  const auto code = [](double angle_deg) { return check_angle(angle_deg, {}).code(); };
  EXPECT_EQ(code(0.5), StatusCode::views_too_close);
  EXPECT_EQ(code(17.0), StatusCode::ok);
  EXPECT_EQ(code(75.0), StatusCode::views_too_far_apart);
  const auto warnings = [](const ViewAngles& angles) {
    WarningSet set;
    warn_about_angles(angles, {}, set);
    return set;
  };
  EXPECT_TRUE(warnings({17.0, 17.0, {}, {}}).empty());
  EXPECT_TRUE(warnings({8.0, 8.0, {}, {}}).holds(Warning::angle_small));
  EXPECT_TRUE(warnings({33.0, 33.0, {}, {}}).holds(Warning::angle_large));
}

// An arm that was sent from −8 to 9 degrees turned the camera by 17, whichever picture came first.
TEST(ViewInput, AnArmMustHaveTurnedAsItWasTold) {
  const auto disagrees = [](double turned_deg, std::optional<double> from, std::optional<double> to) {
    WarningSet set;
    warn_about_angles({17.0, turned_deg, from, to}, {}, set);
    return set.holds(Warning::arm_angle_disagrees);
  };
  EXPECT_FALSE(disagrees(17.2, -8.0, 9.0));
  EXPECT_FALSE(disagrees(17.2, 9.0, -8.0));
  EXPECT_TRUE(disagrees(18.0, -8.0, 9.0));
  EXPECT_TRUE(disagrees(16.0, 9.0, -8.0));
  EXPECT_FALSE(disagrees(30.0, {}, 9.0));
  EXPECT_FALSE(disagrees(30.0, 9.0, {}));
}

}  // namespace
}  // namespace traygauge
