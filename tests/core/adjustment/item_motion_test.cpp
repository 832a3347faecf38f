// An item that moved and turned between two views, by its tracks alone.
#include "core/adjustment/item_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/cameras.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr double kItemFocalPx = 1400.0;
constexpr std::uint8_t kMovedItem = 3;

class ItemMotions : public ::testing::Test {
 protected:
  struct Item {
    std::vector<PointTrack> tracks;
    double across_mm = 0.0;  // root mean square
  };

  ItemMotions() {
    const double azimuth = 6.28 * share();
    cameras_ = {test::camera_above(0.1 + 0.3 * share(), azimuth, 420.0 + 100.0 * share()),
                test::camera_above(0.2 + 0.3 * share(), azimuth + 0.7 + share(), 420.0 + 100.0 * share())};
  }
  double share() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  double unit() { return normal_(random_); }

  // On a lump of 60 mm on a dish, which is shifted and turned about its middle.
  Item move_item(const Vec2& shift_mm, double turn_rad, int points, double noise_px) {
    const Vec2 middle_mm(80.0 * (share() - 0.5), 80.0 * (share() - 0.5));
    const Vec3 first_mm = camera_centre_mm(cameras_[0]);
    const Vec3 second_mm = camera_centre_mm(cameras_[1]);
    Item item;
    double squares = 0.0;
    for (int i = 0; i < points; ++i) {
      const Vec2 lever_mm(60.0 * (share() - 0.5), 60.0 * (share() - 0.5));
      Vec3 point_mm;
      point_mm << middle_mm + lever_mm, 5.0 + 25.0 * share();
      Vec3 moved_mm = point_mm;
      moved_mm.head<2>() = middle_mm + shift_mm + Eigen::Rotation2Dd(turn_rad) * lever_mm;
      // Of the plane through both cameras and the point.
      const Vec2 across = (second_mm - first_mm).cross(point_mm - first_mm).head<2>().normalized();
      const double across_mm = across.dot((moved_mm - point_mm).head<2>());
      squares += across_mm * across_mm;
      PointTrack track;
      track.first = (cameras_[0] * point_mm).hnormalized();
      track.second = (cameras_[1] * moved_mm).hnormalized() + noise_px / kItemFocalPx * Vec2(unit(), unit());
      track.label = kMovedItem;
      item.tracks.push_back(track);
    }
    item.across_mm = std::sqrt(squares / points);
    return item;
  }
  void add_wrong_tracks(Item& item, int count) {
    for (int i = 0; i < count; ++i) {
      PointTrack track = item.tracks[static_cast<std::size_t>(i)];
      track.second += 40.0 / kItemFocalPx * Vec2(unit(), unit());
      item.tracks.push_back(track);
    }
  }
  ItemMotion find(const Item& item, const CamerasMatrix& covariance = CamerasMatrix::Zero()) const {
    // Some contradict the cameras, and come apart.
    const std::span<const PointTrack> tracks(item.tracks);
    return find_item_motion(kMovedItem, {tracks.first(tracks.size() / 3), tracks.subspan(tracks.size() / 3)},
                            cameras_, covariance, kItemFocalPx, {});
  }

  std::mt19937 random_{test::random_seed()};
  std::normal_distribution<double> normal_;
  TableCameras cameras_;
};

TEST_F(ItemMotions, AreFoundBesideWrongTracks) {
  for (int round = 0; round < 100; ++round) {
    const double length_mm = 0.5 + 10.0 * share();
    Item item = move_item(length_mm * Vec2(unit(), unit()).normalized(), 0.1 * (share() - 0.5), 30, 0.1);
    add_wrong_tracks(item, 8);
    const ItemMotion motion = find(item);
    ASSERT_TRUE(motion.is_known);
    EXPECT_NEAR(motion.across_mm, item.across_mm, 0.2 + 0.1 * item.across_mm);
  }
}

TEST_F(ItemMotions, OfWhatStoodStillAreNoMoreThanTheirSigma) {
  for (int round = 0; round < 200; ++round) {
    const ItemMotion motion = find(move_item(Vec2::Zero(), 0.0, 4 + round % 40, 0.15));
    ASSERT_TRUE(motion.is_known);
    EXPECT_LT(motion.across_mm, 4.5 * motion.sigma_mm);
  }
}

TEST_F(ItemMotions, CountForLessTheLessTheCamerasAreKnown) {
  for (int round = 0; round < 100; ++round) {
    const Item item = move_item(Vec2::Zero(), 0.0, 30, 0.1);
    CamerasMatrix covariance = CamerasMatrix::Zero();
    covariance.diagonal().segment<3>(9).setConstant(0.3 * 0.3);
    // The second camera stands elsewhere than the item's tracks have it.
    cameras_[1].translation += 0.3 * Vec3(unit(), unit(), unit());
    const ItemMotion motion = find(item, covariance);
    ASSERT_TRUE(motion.is_known);
    EXPECT_LT(motion.across_mm, 5.5 * motion.sigma_mm);
    EXPECT_GT(motion.sigma_mm, 3.0 * find(item).sigma_mm);
  }
}

TEST_F(ItemMotions, AreUnknownOfFewOrWildTracks) {
  EXPECT_FALSE(find(move_item({5.0, 0.0}, 0.0, 3, 0.1)).is_known);
  EXPECT_FALSE(find({}).is_known);
  int known = 0;
  for (int round = 0; round < 100; ++round) {
    Item item = move_item(Vec2::Zero(), 0.0, 12, 0.1);
    for (PointTrack& track : item.tracks) track.second += 60.0 / kItemFocalPx * Vec2(unit(), unit());
    known += find(item).is_known ? 1 : 0;
  }
  EXPECT_LE(known, 2);
}

}  // namespace
}  // namespace traygauge
