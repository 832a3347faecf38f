// Places that edges vote for: of dishes whose outlines are known in closed form, among edges that mean
// nothing.
#include "core/dish/rim_votes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/core/dish/edge_outlines.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr double kVotedWithinMm = 8.0;  // two cells

DishModel voted_dish(double long_mm, double short_mm) {
  DishModel model;
  model.outer_size_mm = {long_mm, short_mm};
  model.rim_height_mm = 22.0;
  model.bottom_height_mm = 4.0;
  return model;
}

class VotingScene {
 public:
  VotingScene() {
    const TableCameras cameras = test::two_cameras();
    for (std::size_t v = 0; v < 2; ++v) {
      views_[v].lens = test::phone_lens();
      views_[v].camera_from_table = cameras[v];
      edges_[v] = BoundedList<RimEdge>(storage_[v]);
    }
  }

  // `inside_sign` 1: brighter inside, so that the inside lies on the left of the way along the edge.
  void add_rim(const DishModel& dish, const Vec2& centre_mm, double azimuth_rad, int inside_sign) {
    const DishPose place{centre_mm, azimuth_rad, edge_height_mm(dish), dish.outer_size_mm, 0.0};
    for (std::size_t v = 0; v < 2; ++v) {
      const std::vector<Vec2> rays = test::outline_of(place, views_[v].camera_from_table, 400);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Vec2& next = rays[(i + 1) % rays.size()];
        Vec2 along = (next - rays[i]).normalized() / test::kOutlineFocalPx;
        Vec2 inward = Vec2::Zero();
        for (const Vec2& ray : rays) inward += (ray - rays[i]) / static_cast<double>(rays.size());
        // In the picture, whose y points down, left of (x, y) is (y, −x).
        const bool is_inside_left = Vec2(along.y(), -along.x()).dot(inward) > 0.0;
        if (is_inside_left != (inside_sign > 0)) along = -along;
        edges_[v].push_back({rays[i], rays[i] + along});
      }
    }
  }
  void add_clutter(std::mt19937& random, int count) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (auto& list : edges_) {
      for (int i = 0; i < count; ++i) {
        const Vec2 ray(0.5 * unit(random), 0.4 * unit(random));
        list.push_back({ray, ray + Vec2(unit(random), unit(random)).normalized() / test::kOutlineFocalPx});
      }
    }
  }
  std::vector<RimPeak> vote(std::span<const DishModel> candidates, std::span<const FoundDish> taken = {},
                            std::size_t room = kMaxRimPeaks) {
    std::vector<RimPeak> peaks(room);
    peaks.resize(vote_for_places(views_, edges_, candidates, taken, params_, *space_, peaks));
    return peaks;
  }

 private:
  DishSearchParams params_;
  test::Allocated<DishSearchWorkspace> space_{DishSearchParams{}};
  DishSearchViews views_;
  std::array<std::vector<RimEdge>, 2> storage_{std::vector<RimEdge>(8000), std::vector<RimEdge>(8000)};
  RimEdges edges_;
};

TEST(RimVotes, GoToWhereARoundDishStands) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> place(-80.0, 80.0);
  const std::array<DishModel, 1> plates = {voted_dish(200.0, 200.0)};
  for (int round = 0; round < 5; ++round) {
    for (const int inside_sign : {1, -1}) {
      VotingScene scene;
      const Vec2 centre(place(random), place(random));
      scene.add_rim(plates[0], centre, 0.0, inside_sign);
      scene.add_clutter(random, 2000);
      const std::vector<RimPeak> peaks = scene.vote(plates);
      ASSERT_FALSE(peaks.empty());
      EXPECT_LT((peaks[0].place.centre_mm - centre).norm(), kVotedWithinMm);
      EXPECT_EQ(peaks[0].inside_sign, inside_sign);
      EXPECT_EQ(peaks[0].dish, &plates[0]);
      // Of two times 400 edges nearly all lie within three cells, on 628 mm of rim.
      EXPECT_GT(peaks[0].votes_per_mm, 0.9 * 800.0 / 628.0);
      for (std::size_t i = 1; i < peaks.size(); ++i)
        EXPECT_LE(peaks[i].votes_per_mm, peaks[i - 1].votes_per_mm);
    }
  }
}

TEST(RimVotes, TellDishesAndTheTurnOfAnOval) {
  std::mt19937 random(test::random_seed());
  const std::array<DishModel, 3> dishes = {voted_dish(200.0, 200.0), voted_dish(280.0, 190.0),
                                           voted_dish(150.0, 150.0)};
  for (const double azimuth : {0.3, 1.1, 2.6}) {
    VotingScene scene;
    scene.add_rim(dishes[1], Vec2(15.0, -20.0), azimuth, 1);
    scene.add_clutter(random, 1000);
    const std::vector<RimPeak> peaks = scene.vote(dishes);
    ASSERT_FALSE(peaks.empty());
    EXPECT_EQ(peaks[0].dish, &dishes[1]);
    EXPECT_LT((peaks[0].place.centre_mm - Vec2(15.0, -20.0)).norm(), kVotedWithinMm);
    EXPECT_LT(std::abs(std::sin(peaks[0].place.azimuth_rad - azimuth)),
              0.1);  // half of 24 azimuths' step, and more
  }
}

TEST(RimVotes, KeepAwayFromDishesThatWereFound) {
  std::mt19937 random(test::random_seed());
  const std::array<DishModel, 1> plates = {voted_dish(160.0, 160.0)};
  VotingScene scene;
  scene.add_rim(plates[0], Vec2(-90.0, 0.0), 0.0, 1);
  scene.add_rim(plates[0], Vec2(95.0, 10.0), 0.0, 1);
  std::array<FoundDish, 1> taken;
  taken[0].place = {Vec2(-90.0, 0.0), 0.0, edge_height_mm(plates[0]), plates[0].outer_size_mm, 0.0};
  const std::vector<RimPeak> peaks = scene.vote(plates, taken);
  ASSERT_FALSE(peaks.empty());
  EXPECT_LT((peaks[0].place.centre_mm - Vec2(95.0, 10.0)).norm(), kVotedWithinMm);
  for (const RimPeak& peak : peaks) EXPECT_GE((peak.place.centre_mm - Vec2(-90.0, 0.0)).norm(), 160.0);
}

TEST(RimVotes, KeepNoMoreThanThereIsRoomForAndNoneWithoutCandidates) {
  const std::array<DishModel, 1> ovals = {voted_dish(280.0, 190.0)};
  VotingScene scene;
  scene.add_rim(ovals[0], Vec2::Zero(), 0.8, 1);
  const std::vector<RimPeak> all = scene.vote(ovals);
  const std::vector<RimPeak> two = scene.vote(ovals, {}, 2);
  ASSERT_EQ(all.size(), kMaxRimPeaks);
  ASSERT_EQ(two.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(two[i].votes_per_mm, all[i].votes_per_mm);
  EXPECT_TRUE(scene.vote({}).empty());
}

}  // namespace
}  // namespace traygauge
