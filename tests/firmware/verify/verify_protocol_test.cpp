// A small protocol from its plan to its certificate: rendered, measured with an interruption, reported.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <sstream>

#include "firmware/simulate/simulate_command.hpp"
#include "firmware/verify/verify_captures.hpp"
#include "firmware/verify/verify_command.hpp"
#include "firmware/verify/verify_figures.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlan = R"(version = 1
name = "small"
dish = "dinner"
angles_deg = [0.0]
[[bodies]]
proof = "C400"
length_sigma_mm = 0.0
[[bodies]]
proof = "R180"
length_sigma_mm = 0.0
[[places]]
name = "middle"
shift_mm = [0.0, 0.0]
[repeats]
body = "R180"
count = 2
)";

class VerifyProtocol : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder;
    write_text(plan(), kPlan);
    const std::string what = plan().string();
    const std::string out = captures().string();
    const std::array<const char*, 10> arguments = {
        "traygauge-simulate", "verify",    what.c_str(), "--out",    out.c_str(),
        "--reduced",          "--samples", "8",          "--config", TRAYGAUGE_SOURCE_DIR "/config"};
    std::ostringstream said;
    ASSERT_EQ(run_simulate(arguments.size(), arguments.data(), said, said), 0) << said.str();
  }
  static void TearDownTestSuite() { delete folder; }

  static fs::path plan() { return folder->path() / "plan.toml"; }
  static fs::path captures() { return folder->path() / "captures"; }
  fs::path results() const { return own_.path() / "results.jsonl"; }

  static TemporaryFolder* folder;
  TemporaryFolder own_;
};
TemporaryFolder* VerifyProtocol::folder = nullptr;

TEST_F(VerifyProtocol, IsMeasuredWithin8PerCentByGivenAndByFoundOutlines) {
  for (const char* labels : {"given", "auto"}) {
    const fs::path file = own_.path() / labels;
    const CommandResult result = run({"verify", "run", plan().string(), "-o", file.string(), "--captures",
                                      captures().string(), "--labels", labels, "--temperature", "20 °C"});
    EXPECT_EQ(result.status, 0) << result.error;
    EXPECT_NE(result.out.find("4 of 4 steps are done."), std::string::npos) << result.out;
    const VerifyRecord record = read_verify_record(file);
    ASSERT_EQ(record.scans.size(), 4U);
    for (const VerifyScan& scan : record.scans) {
      ASSERT_TRUE(scan.is_measured) << result.out;
      const VerifyBody& body = record.header.plan.bodies[scan.step.starts_with("C400") ? 0 : 1];
      EXPECT_LT(std::abs(verify_error(scan, body)), 8.0) << result.out;
    }
  }
}

TEST_F(VerifyProtocol, GoesOnAfterAnInterruption) {
  // Ended before the first step, and in the middle of the third line.
  std::atomic<bool> stop = true;
  std::ostringstream out;
  VerifyRunOptions options;
  options.plan = plan();
  options.out = results();
  options.captures = captures();
  EXPECT_EQ(run_verify(options, stop, out, out), 1);
  EXPECT_NE(out.str().find("0 of 4 steps are done."), std::string::npos) << out.str();
  stop = false;
  EXPECT_EQ(run_verify(options, stop, out, out), 0);
  const std::string whole = read_text(results());
  const std::size_t second_scan = whole.find("R180-middle-0\",\"attempt\"");
  ASSERT_NE(second_scan, std::string::npos) << whole;
  write_text(results(), whole.substr(0, second_scan + 30));
  EXPECT_EQ(run_verify(options, stop, out, out), 0);
  const VerifyRecord again = read_verify_record(results());
  ASSERT_EQ(again.scans.size(), 4U);
  EXPECT_EQ(again.scans[1].step, "R180-middle-0");
  EXPECT_EQ(again.scans[1].attempt, 1);
  // Nothing is left to do; the record stays as it is.
  const std::string before = read_text(results());
  EXPECT_EQ(run_verify(options, stop, out, out), 0);
  EXPECT_EQ(read_text(results()), before);
}

TEST_F(VerifyProtocol, IsReportedAsTooSmallForAClass) {
  run({"verify", "run", plan().string(), "-o", results().string(), "--captures", captures().string()});
  const CommandResult result =
      run({"verify", "report", results().string(), "-o", (own_.path() / "c").string(), "--config",
           TRAYGAUGE_SOURCE_DIR "/config"});
  EXPECT_EQ(result.status, 1) << result.error;
  EXPECT_NE(result.out.find("The plan has 2 bodies; a class needs 4."), std::string::npos) << result.out;
  EXPECT_NE(read_text(own_.path() / "c" / "certificate.md").find("| camera | 800 × 600, focal length"),
            std::string::npos);
}

// A capture that is refused, with and without a further one of its step.
TEST_F(VerifyProtocol, ARefusedStepTakesItsFurtherCapture) {
  const fs::path own = own_.path() / "captures";
  fs::copy(captures(), own, fs::copy_options::recursive);
  const fs::path bad = own / "R180-middle-0";
  fs::copy(bad, own / "R180-middle-0.2", fs::copy_options::recursive);
  fs::copy_file(bad / "view_0.jpg", bad / "view_1.jpg", fs::copy_options::overwrite_existing);
  fs::copy_file(bad / "labels_0.png", bad / "labels_1.png", fs::copy_options::overwrite_existing);
  const auto verify = [&](const std::string& name) {
    return run(
        {"verify", "run", plan().string(), "-o", (own_.path() / name).string(), "--captures", own.string()});
  };
  EXPECT_EQ(verify("two").status, 0);
  const VerifyRecord two = read_verify_record(own_.path() / "two");
  ASSERT_EQ(two.attempts_at("R180-middle-0"), 2);
  EXPECT_TRUE(two.scans.at(2).is_measured);
  fs::remove_all(own / "R180-middle-0.2");
  EXPECT_EQ(verify("one").status, 0);
  const VerifyRecord one = read_verify_record(own_.path() / "one");
  EXPECT_EQ(one.attempts_at("R180-middle-0"), 1);
  EXPECT_EQ(one.measured("R180-middle-0"), nullptr);
  EXPECT_EQ(verify_figures(one).steps_refused, 1);
}

TEST_F(VerifyProtocol, CapturesOfAnotherSetupAreRefused) {
  const fs::path own = own_.path() / "captures";
  fs::copy(captures(), own, fs::copy_options::recursive);
  const fs::path document = own / "R180-middle-0" / "capture.json";
  std::string text = read_text(document);
  text.replace(text.find("85.6"), 4, "85.2");
  write_text(document, text);
  const CommandResult result =
      run({"verify", "run", plan().string(), "-o", results().string(), "--captures", own.string()});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.error.find("one setup"), std::string::npos) << result.error;
  EXPECT_EQ(read_verify_record(results()).scans.size(), 1U);
}

TEST_F(VerifyProtocol, WhatCannotBeRenderedIsTold) {
  const auto simulate = [&](const std::string& from, const std::string& to) {
    std::string text = kPlan;
    text.replace(text.find(from), from.size(), to);
    write_text(own_.path() / "plan.toml", text);
    const std::string what = (own_.path() / "plan.toml").string();
    const std::string out = (own_.path() / "out").string();
    const std::array<const char*, 7> arguments = {
        "traygauge-simulate",          "verify", what.c_str(), "--out", out.c_str(), "--config",
        TRAYGAUGE_SOURCE_DIR "/config"};
    std::ostringstream said;
    EXPECT_EQ(run_simulate(arguments.size(), arguments.data(), said, said), 2);
    return said.str();
  };
  EXPECT_NE(simulate("proof = \"C400\"\nlength_sigma_mm = 0.0",
                     "name = \"s\"\nvolume_ml = 9.0\nvolume_sigma_ml = 0.0")
                .find("body s"),
            std::string::npos);
  EXPECT_NE(simulate("\"dinner\"", "\"plate\"").find("plate"), std::string::npos);
  EXPECT_NE(simulate("[0.0, 0.0]", "[400.0, 0.0]").find("do not fit"), std::string::npos);
}

}  // namespace
}  // namespace traygauge
