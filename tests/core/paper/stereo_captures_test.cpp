// The dishes of the captures, rectified with their true poses: what dense matching alone does to heights and
// volumes of food.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/core/paper/rectified_capture.hpp"

namespace traygauge::paper {
namespace {

using test::Matcher;
using test::RectifiedCapture;
using test::rectify_capture;
using test::volume_ml;

struct ItemError {
  double median_px = 0.0;
  double percentile95_px = 0.0;
  double bias_px = 0.0;
  double bias_mm = 0.0;  // of the height
  double volume_percent = 0.0;
};

cv::Mat_<float> in_pixels(const cv::Mat_<Disparity>& disparity) {
  cv::Mat_<float> pixels(disparity.size());
  for (int i = 0; i < static_cast<int>(disparity.total()); ++i) {
    pixels(i) =
        disparity(i) == kNoDisparity ? std::nanf("") : static_cast<float>(disparity(i)) / kDisparityScale;
  }
  return pixels;
}

ItemError measure_item(const RectifiedCapture& capture, int label, const cv::Mat_<float>& disparity) {
  std::vector<double> errors;
  ItemError item;
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < disparity.cols; ++x) {
      const float truth = capture.truth(y, x);
      if (capture.labels(y, x) != label || !std::isfinite(truth) || !std::isfinite(disparity(y, x))) continue;
      const double error = disparity(y, x) - truth;
      errors.push_back(std::abs(error));
      item.bias_px += error;
      item.bias_mm += capture.point(x, y, disparity(y, x))[2] - capture.point(x, y, truth)[2];
    }
  }
  if (errors.empty()) return item;
  std::sort(errors.begin(), errors.end());
  const auto count = static_cast<double>(errors.size());
  item.bias_px /= count;
  item.bias_mm /= count;
  item.median_px = errors[errors.size() / 2];
  item.percentile95_px = errors[errors.size() * 95 / 100];
  item.volume_percent =
      100.0 * (volume_ml(capture, label, disparity) / volume_ml(capture, label, capture.truth) - 1.0);
  return item;
}

struct Source {
  const char* folder;
  int second;
};

void print(const char* what, const ItemError& error) {
  std::printf("%-32s median %.2f px, 95 %% %5.2f px, bias %+.3f px %+.2f mm, volume %+5.1f %%\n", what,
              error.median_px, error.percentile95_px, error.bias_px, error.bias_mm, error.volume_percent);
}

// Means over the items, of magnitudes for the first two and of signed values for the rest.
ItemError mean_of(const std::vector<ItemError>& items) {
  ItemError mean;
  const auto count = static_cast<double>(items.size());
  for (const ItemError& item : items) {
    mean.median_px += item.median_px / count;
    mean.percentile95_px += item.percentile95_px / count;
    mean.bias_px += item.bias_px / count;
    mean.bias_mm += item.bias_mm / count;
    mean.volume_percent += item.volume_percent / count;
  }
  return mean;
}

class Captures : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* captures = std::getenv("TRAYGAUGE_CAPTURES");
    if (captures == nullptr) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
    folder_ = captures;
  }

  std::vector<ItemError> match_items(const RectifiedCapture& capture, const StereoParams& params) {
    const auto& pair = capture.pair;
    Matcher matcher(std::max(pair.first.cols, pair.second.cols), pair.first.rows, capture.range.count(),
                    params);
    cv::Mat_<Disparity> disparity;
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(matcher.match(pair, capture.range, disparity).ok());
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    milliseconds_ = std::max(milliseconds_, elapsed.count());
    mebibytes_ = std::max(mebibytes_, static_cast<double>(matcher.bytes()) / (1 << 20));
    const auto pixels = in_pixels(disparity);
    std::vector<ItemError> items;
    for (const auto& [label, name] : capture.names) items.push_back(measure_item(capture, label, pixels));
    return items;
  }

  std::filesystem::path folder_;
  double milliseconds_ = 0.0;
  double mebibytes_ = 0.0;
};

TEST_F(Captures, HeightsOfFoodAreRight) {
  std::vector<ItemError> all;
  double volume_error = 0.0;
  for (const auto& [name, second] :
       {Source{"meals/m01", 1}, Source{"meals/m04", 1}, Source{"meals/m08", 2}, Source{"meals/m11", 1},
        Source{"angles/a01", 3}, Source{"plates/c1_soup", 1}}) {
    const RectifiedCapture capture = rectify_capture(folder_ / name, second);
    const auto items = match_items(capture, {});
    std::size_t i = 0;
    for (const auto& [label, item_name] : capture.names) {
      print((std::string(name) + " 0-" + std::to_string(second) + " " + item_name).c_str(), items[i++]);
    }
    all.insert(all.end(), items.begin(), items.end());
  }
  const ItemError mean = mean_of(all);
  for (const ItemError& item : all)
    volume_error += std::abs(item.volume_percent) / static_cast<double>(all.size());
  print("mean", mean);
  std::printf("mean volume error %.2f %%, at most %.0f ms, %.1f MiB\n", volume_error, milliseconds_,
              mebibytes_);
  EXPECT_LT(mean.median_px, 0.4);
  EXPECT_LT(std::abs(mean.bias_px), 0.15);
  EXPECT_LT(std::abs(mean.bias_mm), 0.3);
  EXPECT_LT(volume_error, 3.0);
}

TEST_F(Captures, EachCostServes) {
  const RectifiedCapture capture = rectify_capture(folder_ / "angles/a01", 3);
  for (const MatchingCost cost : {MatchingCost::census, MatchingCost::sad, MatchingCost::zncc}) {
    StereoParams params;
    params.cost = cost;
    const ItemError mean = mean_of(match_items(capture, params));
    const char* const names[] = {"census", "SAD", "ZNCC"};
    print(names[static_cast<int>(cost)], mean);
    EXPECT_LT(mean.median_px, 0.6);
    EXPECT_LT(std::abs(mean.volume_percent), 6.0);
  }
}

}  // namespace
}  // namespace traygauge::paper
