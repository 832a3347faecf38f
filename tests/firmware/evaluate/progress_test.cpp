#include "firmware/evaluate/progress.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <thread>

namespace traygauge {
namespace {

TEST(Progress, SaysHowMuchIsDoneAndHowLongItTakes) {
  EXPECT_EQ(compose_progress(4, 8, 10.0),
            "[###############               ]  50 %, 4 of 8 measurements, 10 s left");
  EXPECT_EQ(compose_progress(1, 1, 10.0),
            "[##############################] 100 %, 1 of 1 measurements, 0 s left");
  EXPECT_LE(compose_progress(99999, 100000, 1e6).size(), 79U);
}

TEST(Progress, DurationsReadWell) {
  EXPECT_EQ(compose_duration(0.2), "0 s");
  EXPECT_EQ(compose_duration(59.4), "59 s");
  EXPECT_EQ(compose_duration(59.6), "1 min 00 s");
  EXPECT_EQ(compose_duration(200.0), "3 min 20 s");
  EXPECT_EQ(compose_duration(3900.0), "1 h 05 min");
}

TEST(Progress, ShortWorkSaysNothingOutsideATerminal) {
  std::ostringstream stream;
  {
    Progress progress(stream, false);
    for (std::size_t i = 1; i <= 100; ++i) progress.show(i, 100);
  }
  EXPECT_EQ(stream.str(), "");
}

TEST(Progress, TheBarIsWipedAtTheEnd) {
  std::ostringstream stream;
  {
    Progress progress(stream, true);
    std::this_thread::sleep_for(std::chrono::milliseconds(250));  // longer than between two drawings
    progress.show(1, 2);
    EXPECT_NE(stream.str().find("1 of 2 measurements"), std::string::npos);
  }
  const std::string text = stream.str();
  EXPECT_EQ(text.substr(text.size() - 81), "\r" + std::string(79, ' ') + "\r");
}

}  // namespace
}  // namespace traygauge
