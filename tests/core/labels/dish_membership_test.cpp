#include "core/labels/dish_membership.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "tests/support/allocated.hpp"
#include "tests/support/capture_truth.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;
using test::captures_folder;
using test::CaptureTruth;
using test::read_capture_truth;
using test::view_of;

DishOfItem find_dishes(const std::vector<cv::Mat>& pictures, const DishMembershipParams& params = {}) {
  test::Allocated<LabelBorders> memory;
  std::fill(memory->borders_px.begin(), memory->borders_px.end(), 77U);  // of a tray before
  std::vector<ImageView<const std::uint8_t>> views;
  for (const cv::Mat& picture : pictures) views.push_back(view_of(picture));
  return find_dishes_of_items(views, params, *memory);
}

// A row a dish: its label, then items beside each other on it, each 20 pixels wide.
cv::Mat draw_rows(const std::vector<std::vector<int>>& rows) {
  cv::Mat labels = cv::Mat::zeros(60 * static_cast<int>(rows.size()), 200, CV_8U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int top = 60 * static_cast<int>(i);
    labels(cv::Rect(10, top + 10, 180, 40)).setTo(rows[i][0]);
    for (std::size_t k = 1; k < rows[i].size(); ++k) {
      labels(cv::Rect(20 * static_cast<int>(k), top + 20, 20, 20)).setTo(rows[i][k]);
    }
  }
  return labels;
}

TEST(DishMembership, EachItemLiesOnTheDishAroundIt) {
  const DishOfItem dishes = find_dishes({draw_rows({{1, 2, 3, 199}, {201, 4}, {249, 17, 5}})});
  const std::map<std::size_t, int> expected = {{2, 1}, {3, 1}, {199, 1}, {4, 201}, {17, 249}, {5, 249}};
  for (std::size_t label = 0; label < dishes.size(); ++label) {
    const auto known = expected.find(label);
    EXPECT_EQ(dishes[label], known == expected.end() ? 0 : known->second) << label;
  }
}

TEST(DishMembership, ItemsOnOtherItemsLieOnTheirDish) {
  cv::Mat labels = draw_rows({{1, 2}, {201, 3}});
  labels(cv::Rect(24, 84, 12, 12)).setTo(4);  // on 3
  labels(cv::Rect(27, 87, 6, 6)).setTo(5);    // on 4
  const DishOfItem dishes = find_dishes({labels});
  EXPECT_EQ(dishes[3], 201);
  EXPECT_EQ(dishes[4], 201);
  EXPECT_EQ(dishes[5], 201);
}

// One inside the other: every item but the outermost touches items only.
TEST(DishMembership, ALongPileIsFollowedToItsDish) {
  cv::Mat labels(420, 420, CV_8U, cv::Scalar(202));
  for (int item = 199; item >= 2; --item) {
    const int inset = 200 - item;
    labels(cv::Rect(inset, inset, 420 - 2 * inset, 420 - 2 * inset)).setTo(item);
  }
  const DishOfItem dishes = find_dishes({labels});
  for (std::size_t item = 2; item < 200; ++item) EXPECT_EQ(dishes[item], 202) << item;
}

// 3 lies in 2, and its lower right corner is hidden by a bowl that stands in front of the plate.
TEST(DishMembership, AShortBorderWithADishInFrontDoesNotCount) {
  cv::Mat labels(100, 100, CV_8U, cv::Scalar(1));
  labels(cv::Rect(20, 20, 60, 60)).setTo(2);
  labels(cv::Rect(40, 40, 20, 38)).setTo(3);
  labels(cv::Rect(55, 75, 45, 25)).setTo(201);
  EXPECT_EQ(find_dishes({labels})[3], 1);
  EXPECT_EQ(find_dishes({labels}, {.min_dish_border_fraction = 0.0})[3], 201);
}

TEST(DishMembership, AShortBorderCountsWhereNothingElseDoes) {
  cv::Mat labels = cv::Mat::zeros(100, 100, CV_8U);
  labels(cv::Rect(20, 20, 30, 60)).setTo(2);
  labels(cv::Rect(50, 20, 30, 60)).setTo(3);
  labels(cv::Rect(20, 80, 3, 10)).setTo(203);
  const DishOfItem dishes = find_dishes({labels});
  EXPECT_EQ(dishes[2], 203);
  EXPECT_EQ(dishes[3], 203);
}

TEST(DishMembership, WithoutADishThereIsNone) {
  cv::Mat labels = cv::Mat::zeros(60, 60, CV_8U);
  labels(cv::Rect(20, 20, 10, 10)).setTo(2);
  labels(cv::Rect(30, 20, 10, 10)).setTo(3);
  labels(cv::Rect(40, 20, 10, 10)).setTo(kCardLabel);
  labels(cv::Rect(10, 20, 10, 10)).setTo(200);
  EXPECT_EQ(find_dishes({labels}), DishOfItem{});
  EXPECT_EQ(find_dishes({}), DishOfItem{});
  EXPECT_EQ(find_dishes({cv::Mat()}), DishOfItem{});
}

TEST(DishMembership, AmongEqualsTheSmallerLabelWins) {
  cv::Mat labels(40, 80, CV_8U, cv::Scalar(205));
  labels(cv::Rect(40, 0, 40, 40)).setTo(202);
  labels(cv::Rect(30, 10, 20, 20)).setTo(9);
  EXPECT_EQ(find_dishes({labels})[9], 202);
  cv::flip(labels, labels, 1);
  EXPECT_EQ(find_dishes({labels})[9], 202);
}

TEST(DishMembership, BothViewsCount) {
  const auto draw = [](int border_x) {
    cv::Mat labels(40, 80, CV_8U, cv::Scalar(1));
    labels(cv::Rect(border_x, 0, 80 - border_x, 40)).setTo(201);
    labels(cv::Rect(30, 10, 20, 20)).setTo(9);
    return labels;
  };
  const cv::Mat first = draw(42);
  const cv::Mat second = draw(34);
  EXPECT_EQ(find_dishes({first})[9], 1);
  EXPECT_EQ(find_dishes({second})[9], 201);
  EXPECT_EQ(find_dishes({first, second})[9], 201);
  EXPECT_EQ(find_dishes({second, first})[9], 201);
  EXPECT_EQ(find_dishes({first, second, first, first})[9], 1);
}

// From every pixel to each of its four neighbours.
std::map<std::pair<int, int>, std::uint32_t> count_one_by_one(const cv::Mat& labels) {
  std::map<std::pair<int, int>, std::uint32_t> borders;
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      for (const cv::Point step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point at = cv::Point(x, y) + step;
        if (!cv::Rect({}, labels.size()).contains(at)) continue;
        const int label = labels.at<std::uint8_t>(y, x);
        if (label != labels.at<std::uint8_t>(at)) ++borders[{label, labels.at<std::uint8_t>(at)}];
      }
    }
  }
  return borders;
}

TEST(DishMembership, CountsEveryBorderWhateverLabelsSizesAndStrides) {
  constexpr std::array<int, 10> kLabels = {0, 1, 2, 17, 199, 200, 201, 249, 250, 255};
  for (int seed = 1; seed <= 60; ++seed) {
    cv::RNG rng(static_cast<std::uint64_t>(seed));
    cv::Mat whole = cv::Mat::zeros(rng.uniform(1, 120), rng.uniform(1, 150), CV_8U);
    for (int i = 0; i < 25; ++i) {
      const cv::Point centre(rng.uniform(0, whole.cols), rng.uniform(0, whole.rows));
      const int label = kLabels[static_cast<std::size_t>(rng.uniform(0, 10))];
      cv::circle(whole, centre, rng.uniform(0, 25), cv::Scalar(label), cv::FILLED);
    }
    const cv::Mat labels = whole.colRange(whole.cols / 4, whole.cols);
    test::Allocated<LabelBorders> memory;
    const std::array<ImageView<const std::uint8_t>, 1> views = {view_of(labels)};
    find_dishes_of_items(views, {}, *memory);
    auto expected = count_one_by_one(labels);
    for (int item = 2; item < 200; ++item) {
      for (int other = 0; other < 256; ++other) {
        const auto at = static_cast<std::size_t>(256 * item + other);
        ASSERT_EQ(memory->borders_px[at], (expected[{item, other}]))
            << "seed " << seed << ", " << item << " beside " << other;
      }
    }
  }
}

void expect_true_dishes(const CaptureTruth& capture, const std::vector<cv::Mat>& views) {
  const DishOfItem dishes = find_dishes(views);
  const auto found = std::count_if(dishes.begin(), dishes.end(), [](std::uint8_t dish) { return dish != 0; });
  EXPECT_EQ(static_cast<std::size_t>(found), capture.truth["items"].size()) << capture.folder;
  for (const auto& item : capture.truth["items"]) {
    EXPECT_EQ(dishes[item["label"].get<std::size_t>()], item.value("dish_label", 1))
        << capture.folder << " " << item["name"];
  }
}

TEST(DishMembership, IsTheTrueOneInEveryCapture) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  int trays = 0;
  for (const char* set : {"trays", "meals", "plates"}) {
    for (const auto& entry : fs::directory_iterator(captures_folder() / set)) {
      const CaptureTruth capture = read_capture_truth(entry.path());
      trays += capture.description.contains("dishes") ? 1 : 0;
      std::vector<cv::Mat> pictures;
      for (const auto& view : capture.views) {
        pictures.emplace_back(view.read_labels());
        expect_true_dishes(capture, {pictures.back()});
      }
      for (const auto& [first, second] : capture.pairs) {
        expect_true_dishes(
            capture, {pictures[static_cast<std::size_t>(first)], pictures[static_cast<std::size_t>(second)]});
      }
    }
  }
  EXPECT_GT(trays, 0) << "no tray with several dishes";
}

// A round item, 80 px wide, of whose picture a dish to its left hides so much.
TEST(DishMembership, WhatADishHidesALittleOfLiesApart) {
  for (const int covered : {0, 4, 10, 30, 40, 60}) {
    cv::Mat labels = cv::Mat::zeros(200, 300, CV_8U);
    cv::circle(labels, {180, 100}, 40, cv::Scalar(2), cv::FILLED);
    labels(cv::Rect(20, 20, 120 + covered, 160)).setTo(1);
    test::Allocated<LabelBorders> borders;
    const std::vector<ImageView<const std::uint8_t>> views{view_of(labels)};
    find_dishes_of_items(views, {}, *borders);
    EXPECT_EQ(lies_apart(2, {}, *borders), covered < 40) << covered;
  }
}

}  // namespace
}  // namespace traygauge
