#include "firmware/handover/kept_results.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "firmware/journal/posix_file_system.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

class Kept : public ::testing::Test {
 protected:
  KeptResults open() {
    Expected<KeptResults> kept =
        KeptResults::open(posix_file_system(), {folder_.path(), "kitchen", std::uint64_t{1} << 20U});
    EXPECT_TRUE(kept.ok()) << kept.failure();
    return std::move(*kept);
  }

  TemporaryFolder folder_;
};

TEST_F(Kept, ResultsComeBackInOrderAfterARestart) {
  {
    KeptResults kept = open();
    for (int i = 1; i <= 5; ++i)
      ASSERT_TRUE(kept.keep("kitchen-" + std::to_string(i), "document\n" + std::to_string(i)).ok());
  }
  KeptResults kept = open();
  EXPECT_EQ(kept.waiting_count(), 5U);
  for (int i = 1; i <= 5; ++i) {
    const auto oldest = kept.oldest();
    ASSERT_TRUE(oldest.ok() && *oldest);
    EXPECT_EQ((*oldest)->id, "kitchen-" + std::to_string(i));
    EXPECT_EQ((*oldest)->document, "document\n" + std::to_string(i));
    ASSERT_TRUE(kept.remove_oldest(**oldest).ok());
  }
  const auto none = kept.oldest();
  EXPECT_TRUE(none.ok() && !*none);
}

TEST_F(Kept, NumbersGoOnAfterARestart) {
  std::uint64_t last = 0;
  for (int run = 0; run < 3; ++run) {
    KeptResults kept = open();
    for (int i = 0; i < 3; ++i) {
      const auto id = kept.next_id();
      ASSERT_TRUE(id.ok());
      EXPECT_EQ(id->station, "kitchen");
      EXPECT_GT(id->number, last);
      last = id->number;
    }
  }
}

// Somebody deleted the counter's file: what waits must not be given its number again.
TEST_F(Kept, ALostCounterDoesNotRepeatWhatWaits) {
  {
    KeptResults kept = open();
    ASSERT_TRUE(kept.keep("kitchen-4711", "{}").ok());
  }
  std::filesystem::remove(folder_.path() / "last_scan");
  KeptResults kept = open();
  const auto id = kept.next_id();
  ASSERT_TRUE(id.ok());
  EXPECT_GT(id->number, 4711U);
}

TEST_F(Kept, SaysWhenThereIsNoRoomForTheLargestResult) {
  KeptResults kept = open();
  const std::string large(60'000, 'x');
  int count = 0;
  for (; kept.has_room() && count < 1000; ++count) ASSERT_TRUE(kept.keep("kitchen-1", large).ok());
  EXPECT_GT(count, 10);
  EXPECT_LT(count, 20);
  EXPECT_EQ(kept.waiting_count(), static_cast<std::size_t>(count));
}

TEST_F(Kept, OneStationHasTheFolder) {
  const KeptResults kept = open();
  const auto second =
      KeptResults::open(posix_file_system(), {folder_.path(), "kitchen", std::uint64_t{1} << 20U});
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.failure().find(folder_.path().string()), std::string::npos) << second.failure();
}

}  // namespace
}  // namespace traygauge::test
