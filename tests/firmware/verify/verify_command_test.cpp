// `traygauge verify` as people call it, without pictures.
#include "firmware/verify/verify_command.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/firmware/command_runner.hpp"
#include "tests/firmware/verify/sample_record.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

class VerifyCommand : public testing::Test {
 protected:
  fs::path file(const std::string& name) const { return folder_.path() / name; }
  std::string path(const std::string& name) const { return file(name).string(); }

  // A record file with what `record` holds.
  void store(const std::string& name, const VerifyRecord& record) const {
    VerifyLog log(file(name), record.header);
    for (const VerifyScan& scan : record.scans) log.append(scan);
  }
  CommandResult report(const std::string& results, const std::string& wanted) const {
    return run({"verify", "report", path(results), "-o", path("certificate"), "--class", wanted, "--config",
                TRAYGAUGE_SOURCE_DIR "/config"});
  }

  TemporaryFolder folder_;
};

TEST_F(VerifyCommand, WritesAPlanThatItReads) {
  const CommandResult made =
      run({"verify", "plan", "-o", path("plan.toml"), "--dish", "oval", "--length-sigma", "0"});
  EXPECT_EQ(made.status, 0) << made.error;
  EXPECT_NE(made.out.find("40 scans of 5 bodies"), std::string::npos) << made.out;
  const VerifyPlan plan = read_verify_plan(file("plan.toml"));
  EXPECT_EQ(plan.dish, "oval");
  EXPECT_EQ(plan.bodies[0].volume_sigma_ml, 0.0);
  // Somebody may have edited it.
  const CommandResult again = run({"verify", "plan", "-o", path("plan.toml")});
  EXPECT_EQ(again.status, 2);
  EXPECT_NE(again.error.find("there already"), std::string::npos);
}

TEST_F(VerifyCommand, TheReportsStatusIsTheVerdict) {
  store("good", large_record({0.5, -0.5}));
  store("fair", large_record({2.9, 0.9}));
  store("bad", large_record({30.0}));
  EXPECT_EQ(report("good", "A").status, 0);
  EXPECT_EQ(report("fair", "A").status, 1);
  EXPECT_EQ(report("fair", "B").status, 0);
  const CommandResult bad = report("bad", "C");
  EXPECT_EQ(bad.status, 1);
  EXPECT_NE(bad.out.find("FAIL against class C"), std::string::npos) << bad.out;
  EXPECT_NE(read_text(file("certificate") / "certificate.md").find("FAIL"), std::string::npos);
}

TEST_F(VerifyCommand, ATornLineIsTold) {
  store("torn", large_record({0.5, -0.5}));
  const std::string whole = read_text(file("torn"));
  write_text(file("torn"), whole.substr(0, whole.size() - 3));
  const CommandResult result = report("torn", "C");
  EXPECT_EQ(result.status, 1) << result.out;
  EXPECT_NE(result.error.find("not whole"), std::string::npos) << result.error;
  EXPECT_NE(result.out.find("39 of 40 steps"), std::string::npos) << result.out;
}

TEST_F(VerifyCommand, WrongUseIsToldInOneLine) {
  run({"verify", "plan", "-o", path("plan.toml")});
  write_text(file("notes"), "notes\n");
  store("good", large_record({0.5, -0.5}));
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{"verify"}, "--help"},
      {{"verify", "report", path("none")}, "none"},
      {{"verify", "report", path("notes")}, "another file"},
      {{"verify", "report", path("good"), "--class", "D"}, "A, B or C"},
      {{"verify", "report", path("good"), "-o", path("notes"), "--config", TRAYGAUGE_SOURCE_DIR "/config"},
       "no folder"},
      {{"verify", "run", path("plan.toml"), "-o", path("r")}, "--station FILE, or --captures"},
      {{"verify", "run", path("none.toml"), "-o", path("r"), "--captures", path("c")}, "none.toml"},
      {{"verify", "run", path("plan.toml"), "-o", path("r"), "--captures", path("c")},
       "C50-middle-0/capture.json"},
      {{"verify", "run", path("plan.toml"), "-o", path("r"), "--station", path("none.toml")}, "none.toml"},
      {{"verify", "run", path("plan.toml"), "-o", path("r"), "--captures", path("c"), "--station", path("s")},
       "--"},
      {{"verify", "run", path("plan.toml"), "-o", path("r"), "--captures", path("c"), "--labels", "x"},
       "--labels"},
      {{"verify", "plan", "-o", path("p2"), "--length-sigma", "9"}, "--length-sigma"},
  };
  for (const auto& [arguments, named] : mistakes) {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.status, 2) << named;
    EXPECT_NE(result.error.find(named), std::string::npos) << named << ": " << result.error;
    EXPECT_EQ(std::ranges::count(result.error, '\n'), 1) << result.error;
  }
  EXPECT_FALSE(fs::exists(file("r")));
}

}  // namespace
}  // namespace traygauge
