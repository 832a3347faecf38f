#include "firmware/base/build_info.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace traygauge::test {
namespace {

TEST(BuildInfo, SaysPlainlyThatACommitIsNotKnown) {
  const std::string said = describe_build("traygauge");
  EXPECT_EQ(said.find("traygauge " + std::string(program_version()) + "\n"), 0U) << said;
  EXPECT_NE(said.find("\ncommit: not known, because it was not built from a git checkout\n"),
            std::string::npos)
      << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 3);
  for (const char* const library : {"Eigen ", "OpenCV ", "SQLite "}) {
    const std::size_t place = said.find(library);
    ASSERT_NE(place, std::string::npos) << library << said;
    EXPECT_NE(std::isdigit(said[place + std::string(library).size()]), 0) << said;
  }
}

TEST(BuildInfo, SaysTheCommitThatTheProgramTold) {
  set_built_commit("0123456789ab");
  EXPECT_NE(describe_build("traygauge-simulate").find("\ncommit: 0123456789ab\n"), std::string::npos);
  set_built_commit("");
}

}  // namespace
}  // namespace traygauge::test
