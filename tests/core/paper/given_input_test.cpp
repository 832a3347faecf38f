// Matches and motions from elsewhere.
#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>
#include <vector>

#include "core/paper/pose/motion_search.hpp"
#include "tests/core/paper/paper_bench.hpp"

namespace traygauge::paper {
namespace {

// The scene without the card's label, so that each picture is searched once, as a caller would.
class GivenInputTest : public testing::Test {
 protected:
  GivenInputTest() {
    for (std::size_t i = 0; i < 2; ++i) {
      labels_[i] = tray_.views[i].labels;
      for (std::uint8_t& label : labels_[i]) label = label == 255 ? 0 : label;
    }
  }
  ViewInput view(int i) const {
    return tray_.view(i, {labels_[static_cast<std::size_t>(i)].data(), 960, 720});
  }

  const TrayScene& tray_ = default_tray();
  std::array<std::vector<std::uint8_t>, 2> labels_;
  MeasuringBench bench_{configuration_of(tray_)};
};

// OpenCV's SIFT with Lowe's ratio; a card point counts where view, view and pattern agree.
class SiftMatches {
 public:
  SiftMatches(const TrayScene& tray, bool reverse) {
    const auto mat = [](ImageView<const std::uint8_t> picture) {
      return cv::Mat(picture.height, picture.width, CV_8UC1, const_cast<std::uint8_t*>(picture.data));
    };
    const Found first = find(mat(tray.views[reverse ? 1 : 0].gray_view()));
    const Found second = find(mat(tray.views[reverse ? 0 : 1].gray_view()));
    const Found pattern = find(mat(tray.pattern.view()));
    const std::vector<int> to_second = match(first, second);
    const std::vector<int> to_pattern = match(first, pattern);
    const std::vector<int> second_to_pattern = match(second, pattern);
    for (std::size_t i = 0; i < to_second.size(); ++i) {
      if (to_second[i] < 0) continue;
      const auto j = static_cast<std::size_t>(to_second[i]);
      matches.push_back({first.pixel(i), second.pixel(j)});
      if (to_pattern[i] < 0 || second_to_pattern[j] != to_pattern[i]) continue;
      const Vec2 place = pattern.pixel(static_cast<std::size_t>(to_pattern[i]));
      card.push_back({pattern_mm(place, TrayPattern::kWidth, {}), first.pixel(i), second.pixel(j)});
    }
  }

  std::vector<GivenMatch> matches;
  std::vector<GivenCardMatch> card;

 private:
  struct Found {
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    Vec2 pixel(std::size_t i) const { return {keypoints[i].pt.x, keypoints[i].pt.y}; }
  };
  static Found find(const cv::Mat& picture) {
    Found found;
    cv::SIFT::create(2500)->detectAndCompute(picture, {}, found.keypoints, found.descriptors);
    return found;
  }
  static std::vector<int> match(const Found& from, const Found& to) {
    constexpr float kRatio = 0.8F;
    std::vector<std::vector<cv::DMatch>> two;
    cv::BFMatcher(cv::NORM_L2).knnMatch(from.descriptors, to.descriptors, two, 2);
    std::vector<int> best(from.keypoints.size(), -1);
    for (const auto& pair : two) {
      if (pair.size() == 2 && pair[0].distance < kRatio * pair[1].distance)
        best[static_cast<std::size_t>(pair[0].queryIdx)] = pair[0].trainIdx;
    }
    return best;
  }
};

TEST_F(GivenInputTest, SiftMatchesMeasureTheScene) {
  double forward_ml = 0.0;
  for (const bool reverse : {false, true}) {
    const SiftMatches sift(tray_, reverse);
    ASSERT_GE(sift.card.size(), 10U);
    bench_.estimator.reset();
    ASSERT_TRUE(bench_.estimator.add_view_without_features(view(reverse ? 1 : 0)).ok());
    ASSERT_TRUE(bench_.estimator.add_view_without_features(view(reverse ? 0 : 1)).ok());
    ASSERT_TRUE(bench_.estimator.set_matches(sift.matches, sift.card).ok());
    const Measurement& measurement = bench_.estimator.estimate(1);
    ASSERT_TRUE(measurement.status.ok()) << name(measurement.status.code());
    EXPECT_NEAR(measurement.items[0].volume_ml, tray_.volume_ml(), 0.04 * tray_.volume_ml());
    const Pose truth = reverse ? tray_.second_from_first().inverse() : tray_.second_from_first();
    EXPECT_LT((measurement.second_from_first.translation - truth.translation).norm(),
              0.01 * truth.translation.norm());
    EXPECT_LT((measurement.second_from_first.rotation - truth.rotation).norm(), 0.005);
    if (reverse) {
      EXPECT_NEAR(measurement.items[0].volume_ml, forward_ml, 0.02 * forward_ml);
    }
    forward_ml = measurement.items[0].volume_ml;
  }
}

// Such as a repeated letter of the print: right in the first view, elsewhere on the card in the second.
TEST_F(GivenInputTest, CardPointsThatContradictTheMotionAreLeftOut) {
  SiftMatches sift(tray_, false);
  for (std::size_t i = 0; i < sift.card.size(); i += 8)
    sift.card[i].second = sift.card[(i + sift.card.size() / 2) % sift.card.size()].second;
  ASSERT_TRUE(bench_.estimator.add_view_without_features(view(0)).ok());
  ASSERT_TRUE(bench_.estimator.add_view_without_features(view(1)).ok());
  ASSERT_TRUE(bench_.estimator.set_matches(sift.matches, sift.card).ok());
  const Measurement& measurement = bench_.estimator.estimate(1);
  ASSERT_TRUE(measurement.status.ok()) << name(measurement.status.code());
  EXPECT_NEAR(measurement.items[0].volume_ml, tray_.volume_ml(), 0.04 * tray_.volume_ml());
}

// Knows the answer to within a tenth of a degree, and how often it was asked.
class KnownMotion final : public MotionSearch {
 public:
  explicit KnownMotion(const Pose& motion) : motion_(motion) {}
  bool find_motion(std::span<const RayMatch>, double, Random&, Pose& second_from_first) override {
    ++asked;
    second_from_first = {rotation_about({0.001, 0.001, -0.001}) * motion_.rotation, motion_.translation};
    return is_found;
  }
  bool is_found = true;
  int asked = 0;

 private:
  Pose motion_;
};

TEST_F(GivenInputTest, AnotherSearchForTheMotionTakesThePlaceOfRansac) {
  bool is_measured = false;
  // The views are worked in an order of the estimator's choice.
  for (const Pose& motion : {tray_.second_from_first(), tray_.second_from_first().inverse()}) {
    KnownMotion search(motion);
    ASSERT_TRUE(bench_.estimator.set_motion_search(&search).ok());
    const Status status = bench_.measure(view(0), view(1), 1).status;
    EXPECT_EQ(search.asked, 1);
    is_measured = is_measured || status.ok();
    search.is_found = false;
    EXPECT_EQ(bench_.measure(view(0), view(1), 1).status.code(), StatusCode::pose_not_found);
  }
  EXPECT_TRUE(is_measured);
  ASSERT_TRUE(bench_.estimator.set_motion_search(nullptr).ok());
  EXPECT_TRUE(bench_.measure(view(0), view(1), 1).status.ok());
}

TEST_F(GivenInputTest, MatchesNeedTwoViewsAndEndWithThem) {
  const std::vector<GivenMatch> some(50, {Vec2(100, 100), Vec2(120, 100)});
  EXPECT_EQ(bench_.estimator.set_matches(some, {}).code(), StatusCode::wrong_call);
  ASSERT_TRUE(bench_.estimator.add_view(view(0)).ok());
  EXPECT_EQ(bench_.estimator.set_matches(some, {}).code(), StatusCode::wrong_call);
  ASSERT_TRUE(bench_.estimator.add_view(view(1)).ok());
  EXPECT_EQ(bench_.estimator.set_matches({}, {}).code(), StatusCode::wrong_call);
  ASSERT_TRUE(bench_.estimator.set_matches(some, {}).ok());
  EXPECT_FALSE(bench_.estimator.estimate(1).status.ok());
  EXPECT_TRUE(bench_.measure(view(0), view(1)).status.ok()) << "given matches do not outlive their views";
}

}  // namespace
}  // namespace traygauge::paper
