// Which points lie on the table, among levels that hold more of them.
#include "core/adjustment/table_consensus.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/core/paper/motion_scenes.hpp"

namespace traygauge {
namespace {

// Card's middle 0.15 mm, slopes a tenth of a degree.
Mat3 card_prior() {
  const double slope = 0.1 * std::numbers::pi / 180.0;
  return Vec3(0.15 * 0.15, slope * slope, slope * slope).asDiagonal();
}

// Points around the card, `height` over a table with this slope along x.
void add_points(Random& random, int count, double height, double spread, double slope, double from_mm,
                double to_mm, std::vector<TableSighting>& sightings) {
  for (int i = 0; i < count; ++i) {
    const double angle = test::uniform(random, 0.0, 2.0 * std::numbers::pi);
    const double radius = test::uniform(random, from_mm, to_mm);
    TableSighting sighting;
    sighting.x_mm = radius * std::cos(angle);
    sighting.y_mm = radius * std::sin(angle);
    sighting.height_mm =
        slope * sighting.x_mm + height + test::uniform(random, 0.0, spread) + 0.15 * test::normal(random);
    sighting.sigma_mm = 0.15;
    sightings.push_back(sighting);
  }
}

int count_table(std::span<const TableSighting> sightings) {
  int count = 0;
  for (const TableSighting& sighting : sightings) count += sighting.is_table ? 1 : 0;
  return count;
}

TEST(TableConsensus, FindsTheSmallerLevelThatIsTheCards) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    std::vector<TableSighting> sightings;
    const double slope = 0.001 * test::normal(random);
    add_points(random, 60, 0.0, 0.0, slope, 50.0, 250.0, sightings);
    add_points(random, 200, -3.0, 0.0, slope, 250.0, 450.0, sightings);
    add_points(random, 40, 1.0, 14.0, slope, 80.0, 300.0, sightings);
    ASSERT_TRUE(find_table(sightings, card_prior(), {})) << "seed " << seed;
    EXPECT_GE(count_table(std::span(sightings).first(60)), 54) << "seed " << seed;
    EXPECT_LE(count_table(std::span(sightings).last(240)), 6) << "seed " << seed;
  }
}

// A table far below, and a rim that rises through the card's level: neither is the table.
TEST(TableConsensus, FindsNoneWhereNothingStandsOut) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    std::vector<TableSighting> sightings;
    add_points(random, 300, -3.0, 0.0, 0.0, 150.0, 450.0, sightings);
    add_points(random, 120, -3.0, 12.0, 0.0, 100.0, 300.0, sightings);
    found += find_table(sightings, card_prior(), {}) ? 1 : 0;
  }
  EXPECT_LE(found, 2);
}

TEST(TableConsensus, NeedsPoints) {
  std::vector<TableSighting> sightings;
  EXPECT_FALSE(find_table(sightings, card_prior(), {}));
  Random random(1);
  add_points(random, 5, 0.0, 0.0, 0.0, 50.0, 250.0, sightings);
  EXPECT_FALSE(find_table(sightings, card_prior(), {}));
  EXPECT_EQ(count_table(sightings), 0);
}

}  // namespace
}  // namespace traygauge
