#include "firmware/base/time_zone.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <string>

#include "firmware/base/wall_clock.hpp"

namespace traygauge::test {
namespace {

// The zone is the process's: what a test sets does not outlive it.
class TimeZone : public ::testing::Test {
 protected:
  ~TimeZone() override {
    ::unsetenv("TZ");
    ::tzset();
  }
};

TEST_F(TimeZone, GivesTimesAsPeopleThereReadThem) {
  const std::int64_t winter_ms = *parse_utc("2026-11-27T07:40:12.345Z");
  const std::int64_t summer_ms = *parse_utc("2026-07-01T22:30:00.000Z");
  ASSERT_TRUE(set_time_zone("Europe/Berlin").ok());
  EXPECT_EQ(local_text(winter_ms), "2026-11-27T08:40:12.345+01:00");
  EXPECT_EQ(local_text(summer_ms), "2026-07-02T00:30:00.000+02:00");
  ASSERT_TRUE(set_time_zone("America/St_Johns").ok());
  EXPECT_EQ(local_text(winter_ms), "2026-11-27T04:10:12.345-03:30");
  ASSERT_TRUE(set_time_zone("Etc/UTC").ok());
  EXPECT_EQ(local_text(winter_ms), "2026-11-27T07:40:12.345+00:00");
}

// Both hours that the clock shows as 02:30 when summer time ends.
TEST_F(TimeZone, TellsTheTwoHoursOfTheAutumnApart) {
  ASSERT_TRUE(set_time_zone("Europe/Berlin").ok());
  EXPECT_EQ(local_text(*parse_utc("2026-10-25T00:30:00Z")), "2026-10-25T02:30:00.000+02:00");
  EXPECT_EQ(local_text(*parse_utc("2026-10-25T01:30:00Z")), "2026-10-25T02:30:00.000+01:00");
}

TEST_F(TimeZone, RefusesWhatIsNoZone) {
  for (const std::string name :
       {"", "Europe", "Europe/Atlantis", "/etc/passwd", "../../../etc/passwd", "UTC0", "CET-1CEST", "a b"})
    EXPECT_FALSE(set_time_zone(name).ok()) << name;
}

TEST_F(TimeZone, StaysWithinTheYearsThatCanBeWritten) {
  ASSERT_TRUE(set_time_zone("Etc/UTC").ok());
  EXPECT_EQ(local_text(-1), "1970-01-01T00:00:00.000+00:00");
  EXPECT_EQ(local_text(INT64_MAX), "9999-12-31T23:59:59.999+00:00");
}

}  // namespace
}  // namespace traygauge::test
