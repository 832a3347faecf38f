#include "firmware/station/lens_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

constexpr int kPictureWidth = 480;
constexpr int kPictureHeight = 360;
constexpr double kDishX = 240.0;
constexpr double kDishY = 180.0;
constexpr double kDishRadius = 150.0;
constexpr int kParallaxPx = 14;  // by which the second view shows all that stands on the tray elsewhere

struct Disc {
  double x_px = 0.0;
  double y_px = 0.0;
  double radius_px = 0.0;
  double gray = 0.0;
};

// A white dish on a grey tray; its food is a few discs of other greys at other places on every tray.
class LensWatchOfTrays : public testing::Test {
 protected:
  void SetUp() override {
    std::cout << "seed " << kSeed << std::endl;
    for (std::size_t i = 0; i < 2; ++i) {
      pixels_[i].resize(3U * kPictureWidth * kPictureHeight);
      labels_[i].resize(std::size_t{kPictureWidth} * kPictureHeight);
    }
  }

  double draw(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

  void draw_disc(std::size_t view, const Disc& disc, double moved_px) {
    const auto first = [&](double middle) {
      return std::max(0, static_cast<int>(std::ceil(middle - disc.radius_px)));
    };
    for (int y = first(disc.y_px); y < kPictureHeight && y <= disc.y_px + disc.radius_px; ++y) {
      const double middle = disc.x_px + moved_px;
      for (int x = first(middle); x < kPictureWidth && x <= middle + disc.radius_px; ++x) {
        if (std::hypot(x - middle, y - disc.y_px) > disc.radius_px) continue;
        std::fill_n(pixels_[view].begin() + 3 * (y * kPictureWidth + x), 3,
                    static_cast<std::uint8_t>(disc.gray));
      }
    }
  }

  // A tray is pushed in to within 5 pixels.
  void show_tray(const std::vector<Disc>& always_there = {}) {
    const double pushed_px = draw(-5.0, 5.0);
    std::vector<Disc> foods;
    for (int i = 0; i < 6; ++i)
      foods.push_back({kDishX + draw(-90.0, 90.0), kDishY + draw(-90.0, 90.0), 35.0, draw(30.0, 230.0)});
    foods.insert(foods.end(), always_there.begin(), always_there.end());
    for (std::size_t i = 0; i < 2; ++i) {
      const double moved_px = pushed_px + (i == 0 ? 0.0 : kParallaxPx);
      std::fill(pixels_[i].begin(), pixels_[i].end(), std::uint8_t{90});
      draw_disc(i, {kDishX, kDishY, kDishRadius, 220.0}, moved_px);
      for (const Disc& food : foods) draw_disc(i, food, moved_px);
      for (int y = 0; y < kPictureHeight; ++y) {
        for (int x = 0; x < kPictureWidth; ++x)
          labels_[i][static_cast<std::size_t>(y * kPictureWidth + x)] =
              std::hypot(x - kDishX - moved_px, y - kDishY) < kDishRadius ? kDishLabel : kBackgroundLabel;
      }
      if (dirt_on_view_[i]) draw_disc(i, dirt_, 0.0);
    }
    watch_.add({view(0), view(1)});
  }
  void show_trays(int count, const std::vector<Disc>& always_there = {}) {
    for (int i = 0; i < count; ++i) show_tray(always_there);
  }
  WatchedView view(std::size_t i) const {
    return {{pixels_[i].data(), kPictureWidth, kPictureHeight, 3 * kPictureWidth, PixelFormat::bgr8},
            {labels_[i].data(), kPictureWidth, kPictureHeight}};
  }

  static constexpr std::uint32_t kSeed = 20261130;
  std::mt19937 random_{kSeed};
  std::array<std::vector<std::uint8_t>, 2> pixels_;
  std::array<std::vector<std::uint8_t>, 2> labels_;
  Disc dirt_{200.0, 150.0, 12.0, 25.0};
  std::array<bool, 2> dirt_on_view_ = {false, false};
  LensWatchParams params_;
  LensWatch watch_;
};

TEST_F(LensWatchOfTrays, TellsNothingOfCleanTrays) {
  for (int i = 0; i < 3 * params_.trays; ++i) {
    show_tray();
    EXPECT_FALSE(watch_.spot()) << i;
  }
}

TEST_F(LensWatchOfTrays, TellsWhereDirtIsAndHowWide) {
  dirt_on_view_ = {true, true};
  show_trays(params_.trays - 1);
  EXPECT_FALSE(watch_.spot());
  show_tray();
  ASSERT_TRUE(watch_.spot());
  EXPECT_NEAR(watch_.spot()->x_px, dirt_.x_px, 6.0);  // a block
  EXPECT_NEAR(watch_.spot()->y_px, dirt_.y_px, 6.0);
  EXPECT_NEAR(watch_.spot()->width_px, 2.0 * dirt_.radius_px, 10.0);
}

TEST_F(LensWatchOfTrays, TellsDirtThatCameLaterAfterTwoWindowsAtMost) {
  show_trays(params_.trays + 3);
  dirt_on_view_ = {true, true};
  show_trays(2 * params_.trays);
  EXPECT_TRUE(watch_.spot());
}

TEST_F(LensWatchOfTrays, IsQuietAtOnceWhenTheLensWasCleaned) {
  dirt_on_view_ = {true, true};
  show_trays(params_.trays + 5);
  ASSERT_TRUE(watch_.spot());
  dirt_on_view_ = {false, false};
  int trays = 0;
  for (; watch_.spot() && trays < params_.trays; ++trays) show_tray();
  EXPECT_LE(trays, 5);  // until one shows the dish there
  show_trays(params_.trays);
  EXPECT_FALSE(watch_.spot());
}

TEST_F(LensWatchOfTrays, DirtInOnePictureAloneIsNotOnTheLens) {
  dirt_on_view_ = {true, false};
  show_trays(2 * params_.trays);
  EXPECT_FALSE(watch_.spot());
}

TEST_F(LensWatchOfTrays, ABowlOfSoupThatIsAlwaysThereIsNoDirt) {
  show_trays(2 * params_.trays, {{kDishX, kDishY, 60.0, 40.0}});
  EXPECT_FALSE(watch_.spot());
}

TEST_F(LensWatchOfTrays, WhereNoDishStandsThingsMayBeDarkForGood) {
  dirt_on_view_ = {true, true};
  dirt_ = {30.0, 40.0, 12.0, 10.0};
  show_trays(2 * params_.trays);
  EXPECT_FALSE(watch_.spot());
}

TEST_F(LensWatchOfTrays, PicturesOfAnotherSizeBeginAnew) {
  dirt_on_view_ = {true, true};
  show_trays(params_.trays);
  ASSERT_TRUE(watch_.spot());
  WatchedView smaller = view(0);
  smaller.frame.height = kPictureHeight - 30;
  smaller.labels.height = kPictureHeight - 30;
  watch_.add({smaller, smaller});
  EXPECT_FALSE(watch_.spot());
  show_trays(params_.trays - 1);
  EXPECT_FALSE(watch_.spot());
  show_tray();
  EXPECT_TRUE(watch_.spot());
}

TEST_F(LensWatchOfTrays, BlackPicturesAndPicturesWithoutLabelsTellNothing) {
  for (auto& pixels : pixels_) std::fill(pixels.begin(), pixels.end(), std::uint8_t{0});
  for (auto& labels : labels_) std::fill(labels.begin(), labels.end(), kDishLabel);
  for (int i = 0; i < params_.trays; ++i) watch_.add({view(0), view(1)});
  EXPECT_FALSE(watch_.spot());
  dirt_on_view_ = {true, true};
  LensWatch unlabelled;
  for (int i = 0; i < params_.trays; ++i) {
    show_tray();
    WatchedView bare = view(0);
    bare.labels = {};
    unlabelled.add({bare, bare});
  }
  EXPECT_FALSE(unlabelled.spot());
}

}  // namespace
}  // namespace traygauge
