// Banded semi-global matching on stereograms whose disparities are known, and on photographs with
// structured-light truth (Scharstein & Szeliski 2003).
#include "core/stereo/sgm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>

#include "core/base/arena.hpp"
#include "core/stereo/consistency.hpp"
#include "core/stereo/symmetric_census.hpp"
#include "tests/support/capture_truth.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

using test::view_of;

// Matches `first` against `second` with bands of `lanes` that start at `start`.
cv::Mat_<Disparity> match(cv::Mat1b first, cv::Mat1b second, cv::Mat_<std::int16_t> start, int lanes,
                          const SgmParams& params = {}) {
  const int states = first.rows * first.cols * lanes;
  ArenaPlan plan;
  SgmWorkspace planned;
  planned.allocate(plan, first.cols, states);
  cv::Mat1b block(1, static_cast<int>(plan.high_water_bytes()) + 64);
  auto address = reinterpret_cast<std::uintptr_t>(block.data);
  address = (address + kArenaAlignmentBytes - 1) / kArenaAlignmentBytes * kArenaAlignmentBytes;
  Arena arena({reinterpret_cast<std::byte*>(address), plan.high_water_bytes()});
  SgmWorkspace workspace;
  workspace.allocate(arena, first.cols, states);
  EXPECT_FALSE(arena.exhausted());
  cv::Mat1b labels(first.size(), std::uint8_t{1});
  using Codes = cv::Mat_<cv::Vec<std::uint8_t, 4>>;
  std::array<Codes, 2> codes{Codes(first.size()), Codes(first.size())};
  Codes mask(first.size());
  const auto words = [](Codes& picture) {
    return ImageView<std::uint32_t>{reinterpret_cast<std::uint32_t*>(picture.data), picture.cols,
                                    picture.rows};
  };
  transform_symmetric_census(view_of(first), words(codes[0]));
  transform_symmetric_census(view_of(second), words(codes[1]));
  mask_symmetric_census(view_of(labels), words(mask));
  const BandedPair pair{{view_of(first), view_of(second)},
                        {view_of(labels), view_of(labels)},
                        {words(codes[0]), words(codes[1])},
                        words(mask)};
  cv::Mat_<Disparity> disparity(first.size());
  match_sgm(pair, view_of(start), lanes, params, workspace, view_of(disparity));
  return disparity;
}

// A square that is nearer than what is around it.
struct Stereogram {
  cv::Mat1b first = cv::Mat1b(96, 160);
  cv::Mat1b second = cv::Mat1b(96, 160);
  int behind_px;
  int front_px;

  Stereogram(int behind, int front, unsigned seed) : behind_px(behind), front_px(front) {
    std::mt19937 random(seed);
    for (std::uint8_t& p : first) p = static_cast<std::uint8_t>(random());
    for (std::uint8_t& p : second) p = static_cast<std::uint8_t>(random());
    for (const bool front_layer : {false, true}) {
      for (int y = 0; y < first.rows; ++y) {
        for (int x = 0; x < first.cols; ++x) {
          const int partner = x + truth(x, y);
          if (is_front(x, y) == front_layer && partner >= 0 && partner < second.cols)
            second(y, partner) = first(y, x);
        }
      }
    }
  }
  static bool is_front(int x, int y) { return x >= 60 && x < 110 && y >= 30 && y < 70; }
  // Whether the square hides the partner of what is behind, or nearly so.
  bool is_covered(int x, int y) const {
    for (int from = x - (front_px - behind_px) - 8; from <= x + 8; ++from) {
      if (is_front(from, y - 8) || is_front(from, y + 8)) return true;
    }
    return false;
  }
  int truth(int x, int y) const { return is_front(x, y) ? front_px : behind_px; }

  // Share of the samples away from edges whose disparity is not the true one.
  double wrong_fraction(const cv::Mat_<Disparity>& disparity) const {
    int wrong = 0;
    int all = 0;
    for (int y = 8; y < first.rows - 8; ++y) {
      for (int x = 24; x < first.cols - 40; ++x) {
        if (is_front(x - 8, y) != is_front(x + 8, y) || is_front(x, y - 8) != is_front(x, y + 8)) continue;
        if (!is_front(x, y) && is_covered(x, y)) continue;
        ++all;
        wrong += std::abs(disparity(y, x) - truth(x, y) * kDisparityScale) > kDisparityScale / 2;
      }
    }
    return static_cast<double>(wrong) / all;
  }
};

TEST(Sgm, FindsBothSurfaces) {
  const unsigned seed = test::random_seed();
  const Stereogram scene(3, 21, seed);
  for (const int lanes : {32, 48, 64}) {
    const cv::Mat_<std::int16_t> start(scene.first.size(), std::int16_t{-5});
    EXPECT_LT(scene.wrong_fraction(match(scene.first, scene.second, start, lanes)), 0.002);
  }
}

TEST(Sgm, BandsMayDifferFromPixelToPixel) {
  const unsigned seed = test::random_seed();
  const Stereogram scene(-9, 26, seed);
  std::mt19937 random(seed);
  cv::Mat_<std::int16_t> start(scene.first.size());
  for (int y = 0; y < start.rows; ++y) {
    for (int x = 0; x < start.cols; ++x) {
      start(y, x) = static_cast<std::int16_t>(scene.truth(x, y) - 2 - static_cast<int>(random() % 12));
    }
  }
  EXPECT_LT(scene.wrong_fraction(match(scene.first, scene.second, start, 16)), 0.002);
}

TEST(Sgm, BandsOutsideThePictureMatchNothing) {
  const Stereogram scene(0, 5, 1);
  const cv::Mat_<std::int16_t> far(scene.first.size(), std::int16_t{1500});
  const cv::Mat_<Disparity> disparity = match(scene.first, scene.second, far, 16);
  for (const Disparity d : disparity) EXPECT_GE(d, 1500 * kDisparityScale);
}

// Share of the unoccluded pixels of the right-hand picture that are off by more than a pixel. Disparities
// grow from right to left there, as ours do from the first to the second view.
double bad_fraction(const cv::Mat_<Disparity>& disparity, const cv::Mat1b& truth, const cv::Mat1b& other) {
  int bad = 0;
  int all = 0;
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      const double d = 0.25 * truth(y, x);
      const int partner = x + static_cast<int>(std::lround(d));
      if (truth(y, x) == 0 || partner >= other.cols || std::abs(0.25 * other(y, partner) - d) > 1.0) continue;
      ++all;
      bad += std::abs(static_cast<double>(disparity(y, x)) / kDisparityScale - d) > 1.0;
    }
  }
  return static_cast<double>(bad) / all;
}

TEST(Sgm, FewPixelsOfPhotographsAreBad) {
  const auto folder = test::captures_folder();
  if (folder.empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  for (const std::string name : {"cones", "teddy"}) {
    const auto read = [&](const std::string& suffix) -> cv::Mat1b {
      return cv::imread((folder / "real" / "stereo_middlebury2003" / (name + suffix)).string(),
                        cv::IMREAD_GRAYSCALE);
    };
    const cv::Mat1b left = read("-im2.png");
    const cv::Mat1b right = read("-im6.png");
    ASSERT_FALSE(left.empty());
    const cv::Mat_<std::int16_t> start(right.size(), std::int16_t{0});
    const double ours = bad_fraction(match(right, left, start, 64), read("-disp6.pgm"), read("-disp2.pgm"));
    cv::Mat1b left_mirrored;
    cv::Mat1b right_mirrored;
    cv::flip(left, left_mirrored, 1);
    cv::flip(right, right_mirrored, 1);
    const auto matcher = cv::StereoSGBM::create(0, 64, 5, 200, 800);
    matcher->setMode(cv::StereoSGBM::MODE_HH);
    cv::Mat_<Disparity> mirrored;
    matcher->compute(right_mirrored, left_mirrored, mirrored);
    cv::Mat_<Disparity> disparity;
    cv::flip(mirrored, disparity, 1);
    const double theirs = bad_fraction(disparity, read("-disp6.pgm"), read("-disp2.pgm"));
    std::printf("%s: bad pixels %.1f %%, OpenCV's SGBM %.1f %%\n", name.c_str(), 100.0 * ours,
                100.0 * theirs);
    EXPECT_LT(ours, 0.10);
    EXPECT_LT(ours, theirs + 0.02);
  }
}

}  // namespace
}  // namespace traygauge
