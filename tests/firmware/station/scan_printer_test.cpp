#include "firmware/station/scan_printer.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware/measure/measure_report.hpp"

namespace traygauge {
namespace {

class Printed : public testing::Test {
 protected:
  Printed() {
    items_[0].label = 2;
    items_[0].volume_ml = 123.44;
    items_[1].label = 7;
    items_[1].status = StatusCode::item_hidden;
    items_[1].volume_ml = 55.0;
    measurement_.items = items_;
    measurement_.status = StatusCode::partial;
    measurement_.warnings.raise(Warning::angle_small);
    result_.scan = 3;
    result_.tray = "soup";
    result_.measurement = &measurement_;
    result_.duration = std::chrono::milliseconds(1500);
  }
  std::array<ItemResult, 2> items_;
  Measurement measurement_;
  ScanResult result_;
};

TEST_F(Printed, TextNamesItemsAndVolumes) {
  EXPECT_EQ(scan_text(result_), "Scan 3 (soup): item 2 123.4 ml, item 7 item_hidden. " +
                                    compose_message(measurement_) +
                                    " Warning: " + sentence(Warning::angle_small) + "\n");
  items_[1].status = StatusCode::ok;
  measurement_.status = StatusCode::ok;
  EXPECT_EQ(scan_text(result_), std::string("Scan 3 (soup): item 2 123.4 ml, item 7 55.0 ml. Warning: ") +
                                    sentence(Warning::angle_small) + "\n");
}

TEST_F(Printed, JsonIsOneLineAndHasNullForWhatWasNotMeasured) {
  const std::string line = scan_json(result_);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto json = nlohmann::json::parse(line);
  EXPECT_EQ(json["version"], 2);
  EXPECT_EQ(json["scan"], 3);
  EXPECT_EQ(json["tray"], "soup");
  EXPECT_EQ(json["status"], "partial");
  EXPECT_EQ(json["items"][0]["volume_ml"], 123.44);
  EXPECT_TRUE(json["items"][1]["volume_ml"].is_null());
  EXPECT_EQ(json["items"][1]["status"], "item_hidden");
  EXPECT_TRUE(json["relative_angle_deg"].is_null());
  EXPECT_EQ(json["duration_ms"], 1500.0);
  EXPECT_EQ(json["warnings"].size(), 1U);
}

TEST_F(Printed, DeviceFailuresNameDeviceReasonDetailAndErrno) {
  result_.outcome = ScanOutcome::device_failed;
  result_.measurement = nullptr;
  result_.failure = {"camera", {DeviceCode::device_gone, ENODEV}, "port 1-1"};
  EXPECT_EQ(scan_text(result_), "Scan 3 (soup): camera: " + std::string(sentence(DeviceCode::device_gone)) +
                                    " (port 1-1) [No such device]\n");
  const auto json = nlohmann::json::parse(scan_json(result_));
  EXPECT_EQ(json["status"], "device_gone");
  EXPECT_TRUE(json["items"].empty());
}

TEST_F(Printed, ResultsAndFaultsDoNotMix) {
  std::ostringstream out;
  std::ostringstream log;
  ScanPrinter printer(out, log, ScanPrinter::Format::json);
  EXPECT_EQ(printer.deliver(result_), Delivery::done);
  printer.report_fault({"lamp", DeviceCode::io_error, ""});
  printer.report_recovery("lamp");
  EXPECT_EQ(out.str(), scan_json(result_) + "\n");
  EXPECT_EQ(log.str(), "lamp: The device reported an error.\nlamp: works again.\n");
}

TEST_F(Printed, SaysWhenTheResultCouldNotBeWritten) {
  std::ostringstream out;
  std::ostringstream log;
  out.setstate(std::ios::badbit);
  EXPECT_EQ(ScanPrinter(out, log, ScanPrinter::Format::text).deliver(result_), Delivery::failed);
}

}  // namespace
}  // namespace traygauge
