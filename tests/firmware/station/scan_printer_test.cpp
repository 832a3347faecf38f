#include "firmware/station/scan_printer.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware/journal/journal_block.hpp"
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

TEST_F(Printed, JsonTellsChecksAndBlur) {
  measurement_.checks.add({CheckKind::scale_percent, 1, -1.25, 0.25, 1.0, Verdict::warned});
  measurement_.checks.add({CheckKind::item_slip_mm, 2, 0.0, 0.0, 0.25, Verdict::passed});
  measurement_.report.pictures.blur_px = {0.875, 0.0};  // the second card shows too few edges
  const auto json = nlohmann::json::parse(scan_json(result_));
  EXPECT_EQ(json["checks"], nlohmann::json::parse(R"([
      {"name":"scale_percent","label":1,"value":-1.25,"sigma":0.25,"limit":1.0,"verdict":"warned"},
      {"name":"item_slip_mm","label":2,"value":0.0,"sigma":0.0,"limit":0.25,"verdict":"passed"}])"));
  EXPECT_EQ(json["blur_px"], nlohmann::json::parse("[0.875,null]"));
}

TEST_F(Printed, DirtOnTheLensIsToldWithItsPlace) {
  EXPECT_TRUE(nlohmann::json::parse(scan_json(result_))["lens_spot"].is_null());
  result_.lens_spot = LensSpot{812.0, 344.5, 60.0};
  const auto json = nlohmann::json::parse(scan_json(result_));
  EXPECT_EQ(json["lens_spot"], nlohmann::json::parse(R"({"x_px":812.0,"y_px":344.5,"width_px":60.0})"));
  const auto& warning = json["warnings"].back();
  EXPECT_EQ(warning["code"], "lens_spot");
  EXPECT_TRUE(warning["label"].is_null());
  EXPECT_NE(warning["message"].get<std::string>().find("x = 812"), std::string::npos);
  EXPECT_NE(scan_text(result_).find("dirt on the lens"), std::string::npos);
}

// A result has to fit into the station's journal: with all that a tray of sixteen items may say, and each
// number as long as it can be.
TEST_F(Printed, TheLongestResultOfSixteenItemsFitsIntoTheJournal) {
  constexpr double kLong = -1.2345678901234567e-123;
  std::array<ItemResult, 16> items;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto label = static_cast<std::uint8_t>(kLastItemLabel - i);
    items[i] = {label, 255, StatusCode::ok, kLong, kLong, -kLong, kLong, kLong, kLong};
    for (const Warning warning :
         {Warning::food_clipped, Warning::little_texture, Warning::item_hardly_matched, Warning::item_moved,
          Warning::item_uncertain, Warning::items_doubtful})
      measurement_.warnings.raise(warning, label);
  }
  for (std::size_t i = 0; i < kWarningCount; ++i) measurement_.warnings.raise(static_cast<Warning>(i));
  while (measurement_.checks.items().size() < CheckList::kCapacity)
    measurement_.checks.add({CheckKind::dish_height_mm, 255, kLong, kLong, kLong, Verdict::refused});
  measurement_.items = items;
  measurement_.report.pictures.blur_px = {-kLong, -kLong};
  result_.lens_spot = LensSpot{kLong, kLong, kLong};
  const ScanIdentity identity{
      {std::string(32, 'k'), std::numeric_limits<std::uint64_t>::max()}, {}, {}, {kLong, false}};
  const std::string document = scan_json(result_, &identity);
  std::cout << document.size() << " bytes" << std::endl;
  EXPECT_EQ(nlohmann::json::parse(document)["checks"].size(), CheckList::kCapacity);
  EXPECT_LE(document.size() + scan_id_text(identity.id).size() + 1, kMaxPayloadBytes);
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
  EXPECT_EQ(json["checks"], nlohmann::json::array());
  EXPECT_EQ(json["blur_px"], nlohmann::json::parse("[null,null]"));
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
