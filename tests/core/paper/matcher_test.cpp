#include "core/paper/matching/matcher.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <opencv2/features2d.hpp>
#include <random>
#include <vector>

#include "tests/core/paper/feature_scenes.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::paper {
namespace {

constexpr int kCap = 3000;

std::vector<Match> match(const Features& first, const Features& second, const MatcherParams& params,
                         std::size_t capacity = 2 * kCap) {
  static test::Allocated<MatcherWorkspace> memory(kCap);
  std::vector<Match> storage(capacity);
  BoundedList<Match> matches(storage);
  match_features(first.view(), second.view(), params, *memory, matches);
  return {matches.begin(), matches.end()};
}

// The definition, written with OpenCV's brute-force matcher: neighbours among comparable signs by a mask.
std::vector<cv::DMatch> reference_matches(const Features& first, const Features& second, int top,
                                          float ratio) {
  cv::Mat mask(static_cast<int>(first.keypoints.size()), static_cast<int>(second.keypoints.size()), CV_8U);
  for (int i = 0; i < mask.rows; ++i) {
    for (int j = 0; j < mask.cols; ++j) {
      const int product = first.keypoints[static_cast<std::size_t>(i)].laplacian *
                          second.keypoints[static_cast<std::size_t>(j)].laplacian;
      mask.at<std::uint8_t>(i, j) = product >= 0 ? 255 : 0;
    }
  }
  const cv::BFMatcher matcher(cv::NORM_L2);
  std::vector<std::vector<cv::DMatch>> forward;
  std::vector<std::vector<cv::DMatch>> backward;
  matcher.knnMatch(first.mat(), second.mat(), forward, top + 1, mask);
  matcher.knnMatch(second.mat(), first.mat(), backward, top + 1, mask.t());
  const auto distinct = [&](const std::vector<cv::DMatch>& list, int rank) {
    const auto next = static_cast<std::size_t>(rank) + 1;
    return next >= list.size() || list[next].distance >= ratio * list[next - 1].distance;
  };
  std::vector<cv::DMatch> matches;
  for (const auto& list : forward) {
    for (int rank = 0; rank < std::min(top, static_cast<int>(list.size())); ++rank) {
      const cv::DMatch& candidate = list[static_cast<std::size_t>(rank)];
      const auto& back = backward[static_cast<std::size_t>(candidate.trainIdx)];
      for (int rank_back = 0; rank_back < std::min(top, static_cast<int>(back.size())); ++rank_back) {
        const bool same = back[static_cast<std::size_t>(rank_back)].trainIdx == candidate.queryIdx;
        if (same && distinct(list, rank) && distinct(back, rank_back)) matches.push_back(candidate);
      }
    }
  }
  std::sort(matches.begin(), matches.end(), [](const cv::DMatch& a, const cv::DMatch& b) {
    return a.queryIdx != b.queryIdx ? a.queryIdx < b.queryIdx : a.trainIdx < b.trainIdx;
  });
  return matches;
}

void expect_equal(const std::vector<Match>& matches, const std::vector<cv::DMatch>& reference) {
  ASSERT_EQ(matches.size(), reference.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    EXPECT_EQ(matches[i].first, reference[i].queryIdx);
    EXPECT_EQ(matches[i].second, reference[i].trainIdx);
    EXPECT_NEAR(matches[i].distance, reference[i].distance, 1e-5F);
  }
}

TEST(Matcher, EqualsOpenCvOnRandomDescriptors) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    Features first;
    Features second;
    make_pair(random, 150 + random() % 300, 200 + random() % 300, 120, 0.06F, seed % 3 == 0, first, second);
    for (const int top : {1, 2}) {
      for (const float ratio : {1.0F, 1.05F, 1.1F, 1.3F}) {
        const auto reference = reference_matches(first, second, top, ratio);
        EXPECT_GT(reference.size(), 50U);
        expect_equal(match(first, second, {top, ratio}), reference);
      }
    }
  }
}

TEST(Matcher, EqualsOpenCvCrossCheckWithoutSigns) {
  std::mt19937 random(5);
  Features first;
  Features second;
  make_pair(random, 613, 487, 300, 0.05F, false, first, second);
  for (auto* set : {&first, &second}) {
    for (Keypoint& keypoint : set->keypoints) keypoint.laplacian = 0;
  }
  std::vector<cv::DMatch> reference;
  cv::BFMatcher(cv::NORM_L2, true).match(first.mat(), second.mat(), reference);
  expect_equal(match(first, second, {1, 1.0F}), reference);
}

TEST(Matcher, IsSymmetric) {
  std::mt19937 random(9);
  Features first;
  Features second;
  make_pair(random, 400, 350, 200, 0.08F, true, first, second);
  for (const int top : {1, 2}) {
    const auto forward = match(first, second, {top, 1.1F});
    auto backward = match(second, first, {top, 1.1F});
    std::sort(backward.begin(), backward.end(), [](const Match& a, const Match& b) {
      return a.second != b.second ? a.second < b.second : a.first < b.first;
    });
    ASSERT_EQ(forward.size(), backward.size());
    for (std::size_t i = 0; i < forward.size(); ++i) {
      EXPECT_EQ(forward[i].first, backward[i].second);
      EXPECT_EQ(forward[i].second, backward[i].first);
      EXPECT_EQ(forward[i].distance, backward[i].distance);
    }
  }
}

TEST(Matcher, CutoffDropsTheWorstShare) {
  std::mt19937 random(3);
  Features first;
  Features second;
  make_pair(random, 500, 500, 400, 0.1F, false, first, second);
  const auto all = match(first, second, {1, 1.0F, 0.0F});
  std::vector<float> distances;
  for (const Match& m : all) distances.push_back(m.distance);
  std::sort(distances.begin(), distances.end());
  for (const float cutoff : {0.25F, 0.5F, 1.0F}) {
    const auto kept = match(first, second, {1, 1.0F, cutoff});
    const auto dropped = static_cast<std::size_t>(cutoff * static_cast<float>(all.size()));
    ASSERT_EQ(kept.size(), all.size() - dropped);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      EXPECT_LE(kept[i].distance, distances[kept.size() - 1]);
      if (i > 0) {
        EXPECT_LT(kept[i - 1].first, kept[i].first);
      }
    }
  }
}

TEST(Matcher, KeepsTheNearestWhenTheListIsShort) {
  std::mt19937 random(4);
  Features first;
  Features second;
  make_pair(random, 300, 300, 200, 0.1F, false, first, second);
  auto all = match(first, second, {});
  const auto few = match(first, second, {}, 20);
  std::sort(all.begin(), all.end(), [](const Match& a, const Match& b) { return a.distance < b.distance; });
  ASSERT_EQ(few.size(), 20U);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_LE(few[i].distance, all[19].distance);
    if (i > 0) {
      EXPECT_LT(few[i - 1].first, few[i].first);
    }
  }
}

TEST(Matcher, ExactCopiesAreNotDistinct) {
  std::mt19937 random(6);
  Features first;
  first.descriptors = {random_descriptor(random), random_descriptor(random)};
  first.keypoints.resize(2);
  Features second = first;
  second.descriptors.push_back(second.descriptors[0]);
  second.keypoints.resize(3);
  const auto strict = match(first, second, {1, 1.1F});
  ASSERT_EQ(strict.size(), 1U);
  EXPECT_EQ(strict[0].first, 1);
  EXPECT_EQ(match(first, second, {1, 1.0F}).size(), 2U);
}

TEST(Matcher, EmptyAndTinySets) {
  std::mt19937 random(7);
  Features none;
  Features one;
  one.descriptors = {random_descriptor(random)};
  one.keypoints = {{.laplacian = 1}};
  Features other = one;
  other.keypoints[0].laplacian = -1;
  EXPECT_TRUE(match(none, none, {}).empty());
  EXPECT_TRUE(match(one, none, {}).empty());
  EXPECT_TRUE(match(none, one, {}).empty());
  EXPECT_EQ(match(one, one, {}).size(), 1U);
  EXPECT_TRUE(match(one, other, {}).empty()) << "bright never matches dark";
}

TEST(Matcher, TimeAndMemory) {
  test::Allocated<MatcherWorkspace> memory(kCap);
  RecordProperty("workspace_bytes", static_cast<int>(memory.bytes()));
  std::cout << "workspace for " << kCap << " features: " << memory.bytes() << " bytes\n";
  for (const bool signs : {false, true}) {
    std::mt19937 random(8);
    Features first;
    Features second;
    make_pair(random, 2500, 2500, 1200, 0.05F, false, first, second);
    if (!signs) {
      for (auto* set : {&first, &second}) {
        for (Keypoint& keypoint : set->keypoints) keypoint.laplacian = 0;
      }
    }
    const auto start = std::chrono::steady_clock::now();
    const auto matches = match(first, second, {});
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    std::cout << (signs ? "with signs " : "without    ") << time.count() << " ms, " << matches.size()
              << " matches\n";
    EXPECT_GT(matches.size(), 1000U);
  }
}

}  // namespace
}  // namespace traygauge::paper
