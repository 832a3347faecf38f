// The program as it is where SURF is not built: every command that measures says why it does not.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/firmware/command_runner.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

TEST(ProgramWithoutSurf, RefusesProfilePaper) {
  const TemporaryCapture files;
  const std::string folder = files.folder().string();
  for (std::vector<std::string> arguments :
       {std::vector<std::string>{"measure", folder, "--json"}, std::vector<std::string>{"evaluate", folder},
        std::vector<std::string>{"station", "--devices", "simulator:" + folder, "--once"}}) {
    arguments.insert(arguments.end(), {"--profile", "paper"});
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments[0];
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
    EXPECT_NE(result.error.find("2027"), std::string::npos) << result.error;
    EXPECT_NE(result.error.find("-DTRAYGAUGE_SURF=ON"), std::string::npos) << result.error;
  }
}

TEST(ProgramWithoutSurf, StillSaysWhatMemoryItTakes) {
  EXPECT_EQ(run({"memory"}).status, 0);
}

}  // namespace
}  // namespace traygauge
