#include "firmware/handover/next_tray.hpp"

#include <gtest/gtest.h>

#include <string>

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;

const NextTray::Time kBegin{};
const TrayHint kHint{"order 4711", 3, {"soup"}};
const ToldTray kTold{kHint, milliseconds(1000)};

TEST(NextTray, IsKnownForItsTime) {
  NextTray next;
  EXPECT_EQ(next.use(kBegin), TrayHint());
  next.tell(kTold, kBegin);
  EXPECT_EQ(next.at(kBegin + milliseconds(400))->valid_for, milliseconds(600));
  EXPECT_EQ(next.use(kBegin + milliseconds(999)), kHint);
  EXPECT_EQ(next.use(kBegin + milliseconds(1000)), TrayHint());
  EXPECT_FALSE(next.at(kBegin + milliseconds(1000)));
}

TEST(NextTray, IsOverOnceItWasMeasured) {
  NextTray next;
  next.tell(kTold, kBegin);
  EXPECT_EQ(next.use(kBegin), kHint);
  next.use_ended(false);
  EXPECT_EQ(next.use(kBegin), kHint);
  next.use_ended(true);
  EXPECT_EQ(next.use(kBegin), TrayHint());
}

// The till has gone on to the tray after the one that is measured.
TEST(NextTray, ToldDuringAScanIsOfTheTrayAfterIt) {
  NextTray next;
  next.tell(kTold, kBegin);
  EXPECT_EQ(next.use(kBegin), kHint);
  const TrayHint other{"order 4712", 1, {}};
  next.tell({other, milliseconds(1000)}, kBegin);
  next.use_ended(true);
  EXPECT_EQ(next.use(kBegin), other);
}

TEST(NextTray, CanBeTakenBack) {
  NextTray next;
  next.tell(kTold, kBegin);
  next.tell({}, kBegin);
  EXPECT_EQ(next.use(kBegin), TrayHint());
}

TEST(NextTray, IsReadAsItIsWritten) {
  for (const ToldTray& told :
       {kTold, ToldTray{{"", 0, {}}, milliseconds(0)}, ToldTray{{"ä\"", 198, {}}, milliseconds(7)}}) {
    const Expected<ToldTray> read = read_told_tray(told_tray_json(told), {"dinner", "soup"});
    ASSERT_TRUE(read.ok()) << read.failure();
    EXPECT_EQ(read->hint, told.hint);
    EXPECT_EQ(read->valid_for, told.valid_for);
  }
}

TEST(NextTray, OfAnotherFormIsRefused) {
  const auto failure = [](const std::string& json) {
    const Expected<ToldTray> read = read_told_tray(json, {"dinner"});
    EXPECT_FALSE(read.ok()) << json;
    return read.ok() ? std::string() : read.failure();
  };
  for (const char* json : {"", "{", "[]", "3", "null"})
    EXPECT_EQ(failure(json).find("expected a JSON object"), 0U);
  for (const char* valid :
       {"", R"("valid_ms":-1)", R"("valid_ms":1.5)", R"("valid_ms":3600001)", R"("valid_ms":"1")"})
    EXPECT_EQ(failure(std::string("{").append(valid).append("}")).find("valid_ms:"), 0U) << valid;
}

}  // namespace
}  // namespace traygauge::test
