// A person and a station, without either: what is prompted, kept and repeated.
#include <gtest/gtest.h>

#include <array>
#include <sstream>
#include <string>

#include "firmware/station/scan_printer.hpp"
#include "firmware/verify/verify_station.hpp"
#include "tests/firmware/station/station_rig.hpp"
#include "tests/firmware/verify/sample_record.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

// A measurement with so many items of this volume.
class Measured {
 public:
  explicit Measured(double volume_ml, std::size_t count = 1) {
    for (std::size_t i = 0; i < count; ++i) {
      items_.at(i).label = static_cast<std::uint8_t>(2 + i);
      items_.at(i).volume_ml = volume_ml;
      items_.at(i).sigma_ml = 1.5;
    }
    measurement.items = std::span(items_).first(count);
  }
  Measurement measurement;

 private:
  std::array<ItemResult, 2> items_{};
};

class VerifyStation : public testing::Test {
 protected:
  Delivery deliver(const Measurement& measurement) {
    ScanResult result;
    const bool is_ok = is_measured(measurement);
    result.outcome = is_ok ? ScanOutcome::measured : ScanOutcome::not_measurable;
    result.measurement = &measurement;
    return sink.deliver(result);
  }
  bool has_said(const std::string& text) const { return out.str().find(text) != std::string::npos; }

  TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "results.jsonl";
  VerifyLog log{file, sample_header()};
  std::ostringstream out;
  VerifyGuide guide{log, out};
  ScanPrinter printer{out, out, ScanPrinter::Format::text};
  std::atomic<bool> stop = false;
  std::atomic<bool> ended = false;
  VerifySink sink{guide, "dinner", printer, stop, ended};
};

TEST_F(VerifyStation, SaysWhatToLayWhereAndTellsTheStationWhatLiesThere) {
  guide.prompt();
  EXPECT_TRUE(
      has_said("Step 1 of 10, a-middle-0: lay body a (100.0 ml) on the flat of the dish \"dinner\", its "
               "length from left to right; the dish in the middle of the tray"))
      << out.str();
  const TrayHint hint = sink.next_tray();
  EXPECT_EQ(hint.tray, "a-middle-0");
  EXPECT_EQ(hint.foods, 1);
  EXPECT_EQ(hint.dishes, std::vector<std::string>{"dinner"});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(deliver(Measured(101.0).measurement), Delivery::done);
  EXPECT_TRUE(has_said("turned by 45 degrees counter-clockwise")) << out.str();
  EXPECT_TRUE(has_said("the dish 30 mm to the left, 10 mm away from you of the middle of the tray"))
      << out.str();
  EXPECT_TRUE(has_said("a-middle-0: 101.0 ± 1.5 ml, +1.0 %")) << out.str();
  EXPECT_EQ(read_verify_record(file).scans.size(), 3U);
}

TEST_F(VerifyStation, ARefusedScanIsKeptAndRepeated) {
  Measurement refused;
  refused.status = StatusCode::card_not_found;
  EXPECT_EQ(deliver(refused), Delivery::done);
  EXPECT_TRUE(has_said("refused (card_not_found)")) << out.str();
  EXPECT_TRUE(has_said("the step is repeated"));
  EXPECT_EQ(sink.next_tray().tray, "a-middle-0");
  EXPECT_EQ(deliver(refused), Delivery::done);
  EXPECT_TRUE(has_said("the last attempt"));
  EXPECT_EQ(sink.next_tray().tray, "a-middle-45");
  const VerifyRecord record = read_verify_record(file);
  ASSERT_EQ(record.scans.size(), 2U);
  EXPECT_EQ(record.scans[1].attempt, 2);
  EXPECT_EQ(record.scans[1].status, "card_not_found");
  EXPECT_FALSE(record.scans[1].message.empty());
}

TEST_F(VerifyStation, OneBodyHasToBeOneItem) {
  deliver(Measured(50.0, 2).measurement);
  const VerifyRecord record = read_verify_record(file);
  ASSERT_EQ(record.scans.size(), 1U);
  EXPECT_FALSE(record.scans[0].is_measured);
  EXPECT_EQ(record.scans[0].status, "not_one_item");
}

TEST_F(VerifyStation, WhatADeviceSpoiltIsNoAttempt) {
  ScanResult result;
  result.outcome = ScanOutcome::cancelled;
  EXPECT_EQ(sink.deliver(result), Delivery::done);
  EXPECT_TRUE(has_said("Step 1 of 10"));
  EXPECT_TRUE(read_verify_record(file).scans.empty());
}

TEST_F(VerifyStation, EndsWhenAllIsDoneOrSomebodyWantsIt) {
  for (int i = 0; i < 9; ++i) deliver(Measured(100.0).measurement);
  sink.attend();
  EXPECT_FALSE(ended);
  EXPECT_TRUE(has_said("lift body b (200.0 ml) and lay it again"));
  deliver(Measured(100.0).measurement);
  EXPECT_TRUE(ended);
  EXPECT_EQ(guide.next(), nullptr);
  ended = false;
  stop = true;
  sink.attend();
  EXPECT_TRUE(ended);
}

// The whole loop: ten steps, the second of them refused once; more presses would come.
TEST_F(VerifyStation, LeadsAStationThroughItsSteps) {
  StationRig rig(20);
  rig.measurer.on_measure = [&rig] {
    rig.measurer.status = rig.measurer.scans == 2 ? Status(StatusCode::card_not_found) : Status();
  };
  StationParams params;
  params.repeat_within = {};
  Station station(*rig.devices, rig.measurer, sink, ended, params);
  station.run();
  const VerifyRecord record = read_verify_record(file);
  ASSERT_EQ(record.scans.size(), 11U);
  EXPECT_EQ(record.scans[1].step, "a-middle-45");
  EXPECT_FALSE(record.scans[1].is_measured);
  EXPECT_EQ(record.scans[2].step, "a-middle-45");
  EXPECT_TRUE(record.scans[2].is_measured);
  EXPECT_EQ(guide.next(), nullptr);
  EXPECT_EQ(station.totals().scans, 11U);
  ASSERT_EQ(rig.measurer.hints.size(), 11U);
  EXPECT_EQ(rig.measurer.hints[2].tray, "a-middle-45");
  EXPECT_EQ(rig.measurer.hints[10].tray, "b-repeat-02");
  EXPECT_EQ(rig.measurer.hints[10].foods, 1);
}

// A camera that fails in between spoils no step, and Ctrl-C leaves what was measured.
TEST_F(VerifyStation, GoesOnAfterADeviceThatFailedAndAfterAnEnd) {
  StationRig rig(20);
  Fault fault;
  fault.action = FaultKind::off;
  fault.after_calls = 5;
  rig.camera.faults().add(fault);
  rig.measurer.on_measure = [&] { stop = rig.measurer.scans >= 4; };
  Station station(*rig.devices, rig.measurer, sink, ended);
  station.run();
  const VerifyRecord record = read_verify_record(file);
  ASSERT_GE(record.scans.size(), 3U);
  EXPECT_LT(record.scans.size(), 10U);
  for (std::size_t i = 0; i < record.scans.size(); ++i) {
    EXPECT_TRUE(record.scans[i].is_measured);
    EXPECT_EQ(record.scans[i].step, record.header.plan.steps[i].id);
  }
}

}  // namespace
}  // namespace traygauge
