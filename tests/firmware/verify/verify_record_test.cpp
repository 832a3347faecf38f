// That nothing is lost: the record is interrupted, damaged, shared.
#include "firmware/verify/verify_record.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "firmware/base/exit_status.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/output_file.hpp"
#include "tests/firmware/verify/sample_record.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

class VerifyRecordFile : public testing::Test {
 protected:
  fs::path file() const { return folder_.path() / "results.jsonl"; }
  std::string content() const {
    std::ifstream stream(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write(const std::string& text) const { std::ofstream(file(), std::ios::binary) << text; }

  // Three scans, one of them refused.
  std::string three_scans() {
    VerifyLog log(file(), sample_header());
    log.append(measured_scan("a-middle-0", 101.5));
    log.append(refused_scan("a-middle-45"));
    VerifyScan warned = measured_scan("a-middle-45", 99.25, 0.5);
    warned.attempt = 2;
    warned.warnings = {"low_texture", "items_doubtful"};
    log.append(warned);
    return content();
  }

  TemporaryFolder folder_;
};

TEST_F(VerifyRecordFile, KeepsWhatItWasGiven) {
  three_scans();
  const VerifyRecord record = read_verify_record(file());
  EXPECT_EQ(record.header.program, "1.2.3");
  EXPECT_EQ(record.header.started, "2026-11-27T07:40:12.345Z");
  ASSERT_EQ(record.header.conditions.size(), 2U);
  EXPECT_EQ(record.header.conditions[1].value, "21 °C");
  EXPECT_EQ(record.header.plan.bodies[1].volume_ml, 200.0);
  EXPECT_EQ(record.header.plan.places[1].shift_mm, (std::array{-30.0, 10.0}));
  EXPECT_EQ(record.header.plan.steps.size(), 10U);
  ASSERT_EQ(record.scans.size(), 3U);
  EXPECT_EQ(record.scans[0].volume_ml, 101.5);
  EXPECT_FALSE(record.scans[1].is_measured);
  EXPECT_EQ(record.scans[1].message, "The card was not found.");
  EXPECT_EQ(record.scans[2].attempt, 2);
  EXPECT_EQ(record.scans[2].sigma_ml, 0.5);
  EXPECT_EQ(record.scans[2].warnings, (std::vector<std::string>{"low_texture", "items_doubtful"}));
  EXPECT_FALSE(record.was_torn);
}

TEST_F(VerifyRecordFile, GoesOnWhereItEnded) {
  three_scans();
  VerifyHeader header = sample_header();
  header.started = "2026-11-28T00:00:00.000Z";  // the one thing that may differ
  VerifyLog log(file(), header);
  EXPECT_EQ(log.record().header.started, "2026-11-27T07:40:12.345Z");
  EXPECT_EQ(log.next()->id, "a-left-0");
}

TEST_F(VerifyRecordFile, ARefusedStepIsRepeatedAsOftenAsThePlanSays) {
  VerifyLog log(file(), sample_header());
  EXPECT_EQ(log.next()->id, "a-middle-0");
  log.append(refused_scan("a-middle-0"));
  EXPECT_EQ(log.next()->id, "a-middle-0");
  log.append(refused_scan("a-middle-0"));
  EXPECT_EQ(log.next()->id, "a-middle-45");
  VerifyScan last = refused_scan("a-middle-45");
  last.is_last = true;
  log.append(last);
  EXPECT_EQ(log.next()->id, "a-left-0");
  while (log.next() != nullptr) log.append(measured_scan(log.next()->id, 100.0));
  EXPECT_EQ(log.record().scans.size(), 3U + 8U);
}

// Whatever a crash leaves of the file, each whole line counts, and the test goes on.
TEST_F(VerifyRecordFile, SurvivesAnInterruptionAnywhere) {
  const std::string whole = three_scans();
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    // Around the ends of lines at every byte, within them at some: a sync takes its time.
    const bool is_near_end = whole.substr(length < 3 ? 0 : length - 3, 6).find('\n') != std::string::npos;
    if (!is_near_end && length % 29 != 0) continue;
    const std::string left = whole.substr(0, length);
    write(left);
    const auto lines = static_cast<std::size_t>(std::count(left.begin(), left.end(), '\n'));
    const std::size_t scans = lines == 0 ? 0 : lines - 1;
    {
      VerifyLog log(file(), sample_header());
      ASSERT_EQ(log.record().scans.size(), scans) << length;
      log.append(measured_scan(log.next()->id, 77.0));
    }
    const VerifyRecord after = read_verify_record(file());
    ASSERT_EQ(after.scans.size(), scans + 1) << length;
    ASSERT_EQ(after.scans.back().volume_ml, 77.0);
    ASSERT_FALSE(after.was_torn);
  }
}

TEST_F(VerifyRecordFile, AReaderLeavesOutALineThatIsNotWhole) {
  const std::string whole = three_scans();
  write(whole.substr(0, whole.size() - 5));
  const VerifyRecord record = read_verify_record(file());
  EXPECT_TRUE(record.was_torn);
  EXPECT_EQ(record.scans.size(), 2U);
}

TEST_F(VerifyRecordFile, DamageIsTold) {
  const std::string whole = three_scans();
  const auto fault_of = [&](const std::string& text) {
    write(text);
    try {
      read_verify_record(file());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::size_t second = whole.find('\n') + 1;
  std::string broken = whole;
  broken[second] = '[';
  EXPECT_NE(fault_of(broken).find("line 2"), std::string::npos) << fault_of(broken);
  const auto swapped = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    return text.replace(text.find(from), from.size(), to);
  };
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"\"step\":\"a-middle-0\"", "\"step\":\"z\""},
                                                        {"\"volume_ml\":101.5", "\"volume_ml\":\"x\""},
                                                        {"\"volume_ml\":101.5", "\"volume_ml\":-4"},
                                                        {"\"attempt\":1", "\"attempt\":0"},
                                                        {"\"traygauge_verify\":1", "\"traygauge_verify\":2"},
                                                        {"\"bodies\":[", "\"bodied\":["},
                                                        {"\"body\":1", "\"body\":9"}}) {
    const std::string fault = fault_of(swapped(from, to));
    EXPECT_NE(fault.find("line "), std::string::npos) << from << ": " << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }
  EXPECT_NE(fault_of("").find("no whole line"), std::string::npos);
  EXPECT_NE(fault_of("# notes\n").find("another file"), std::string::npos);
  EXPECT_THROW(read_verify_record(folder_.path() / "none"), InputError);
}

// A file of somebody else's stays as it is.
TEST_F(VerifyRecordFile, NoOtherFileIsWrittenTo) {
  write("my notes");
  EXPECT_THROW(VerifyLog(file(), sample_header()), InputError);
  EXPECT_EQ(content(), "my notes");
  EXPECT_THROW(VerifyLog(folder_.path() / "none" / "r", sample_header()), OutputError);
}

TEST_F(VerifyRecordFile, AnotherTestIsRefused) {
  const std::string before = three_scans();
  VerifyHeader program = sample_header();
  program.program = "1.2.4";
  VerifyHeader conditions = sample_header();
  conditions.conditions[0].value = "another";
  VerifyHeader body = sample_header();
  body.plan.bodies[0].volume_ml = 101.0;
  VerifyHeader steps = sample_header();
  steps.plan.steps.pop_back();
  for (const VerifyHeader& header : {program, conditions, body, steps})
    EXPECT_THROW(VerifyLog(file(), header), UsageError);
  EXPECT_EQ(content(), before);
}

TEST_F(VerifyRecordFile, OneRunWritesAtATime) {
  const VerifyLog first(file(), sample_header());
  EXPECT_THROW(VerifyLog(file(), sample_header()), UsageError);
}

}  // namespace
}  // namespace traygauge
