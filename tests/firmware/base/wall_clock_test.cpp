#include "firmware/base/wall_clock.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <random>

#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

constexpr std::int64_t kEndOf9999Ms = 253402300799999;

TEST(WallClock, WritesTimesAsTheCLibraryDoes) {
  std::mt19937_64 random(random_seed());
  std::uniform_int_distribution<std::int64_t> any_ms(0, kEndOf9999Ms);
  for (int i = 0; i < 10000; ++i) {
    const std::int64_t unix_ms = any_ms(random);
    const auto seconds = static_cast<std::time_t>(unix_ms / 1000);
    std::tm parts{};
    ASSERT_NE(::gmtime_r(&seconds, &parts), nullptr);
    std::array<char, 64> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
    ASSERT_EQ(utc_text(unix_ms).substr(0, 19), text.data()) << unix_ms;
    ASSERT_EQ(parse_utc(utc_text(unix_ms)), unix_ms);
  }
}

TEST(WallClock, KeepsToYearsOfFourDigits) {
  EXPECT_EQ(utc_text(-1), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(utc_text(std::numeric_limits<std::int64_t>::max()), "9999-12-31T23:59:59.999Z");
}

TEST(WallClock, ReadsFractionsOfAnyLength) {
  EXPECT_EQ(parse_utc("1970-01-01T00:00:01Z"), 1000);
  EXPECT_EQ(parse_utc("1970-01-01T00:00:01.5Z"), 1500);
  EXPECT_EQ(parse_utc("1970-01-01T00:00:01.123456Z"), 1123);
}

TEST(WallClock, RefusesWhatIsNoTime) {
  for (const char* const text :
       {"", "Z", "2026-11-27", "2026-11-27T07:40:12", "2026-11-27 07:40:12Z", "2026-13-01T00:00:00Z",
        "2026-02-29T00:00:00Z", "2026-11-27T24:00:00Z", "2026-11-27T07:60:00Z", "2026-11-27T07:40:60Z",
        "2026-11-27T07:40:12.Z", "2026-11-27T07:40:12.12345678901Z", "2026-11-27T07:40:12,5Z",
        "1969-12-31T23:59:59Z", "+026-11-27T07:40:12Z", "2026-11-27T07:40:12+01:00"}) {
    EXPECT_FALSE(parse_utc(text)) << "'" << text << "'";
  }
}

TEST(WallClock, IsTheSystemsClock) {
  using std::chrono::system_clock;
  const std::int64_t before =
      std::chrono::duration_cast<std::chrono::milliseconds>(system_clock::now().time_since_epoch()).count();
  const std::int64_t read = read_wall_clock().unix_ms;
  EXPECT_GE(read, before);
  EXPECT_LT(read - before, 60'000);
}

}  // namespace
}  // namespace traygauge::test
