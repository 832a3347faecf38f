// The program as it is built with -DTRAYGAUGE_PAPER=OFF: its sources for the command line, and those alone.
#include <gtest/gtest.h>

#include <string>

#include "core/paper/pipeline/configuration.hpp"
#include "firmware/base/exit_status.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/paper/paper_profile.hpp"

namespace traygauge {
namespace {

TEST(WithoutPaper, TheProfileIsRefusedInASentence) {
  ASSERT_FALSE(has_paper_profile());
  EXPECT_EQ(choose_profile(""), Profile::best);
  EXPECT_EQ(choose_profile("best"), Profile::best);
  try {
    choose_profile("paper");
    FAIL() << "was chosen";
  } catch (const UsageError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("built without it"), std::string::npos) << text;
    EXPECT_NE(text.find("TRAYGAUGE_PAPER=ON"), std::string::npos) << text;
  }
}

TEST(WithoutPaper, ThereIsNoEstimatorAndNoMemoryForOne) {
  EXPECT_EQ(open_paper_estimator({}), nullptr);
  EXPECT_TRUE(describe_paper_memory({}).empty());
  EXPECT_EQ(paper_bytes({}), 0U);
}

}  // namespace
}  // namespace traygauge
