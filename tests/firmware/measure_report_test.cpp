// The JSON document and the table of measurements that succeeded, succeeded in part, and failed.
#include "firmware/measure/measure_report.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/firmware/fake/synthetic_scene.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::json;

class Report : public testing::Test {
 protected:
  Report() : scene_(320, 240), measurement_(scene_.measurement()) {
    report_.capture = "meals/m01";
    report_.pair = {0, 2};
    report_.profile = "paper";
    report_.seed = 18446744073709551615ULL;
    report_.measurement = &measurement_;
    report_.setup_ms = 3.5;
    report_.reserved_bytes = 20'000'000;
    report_.used_bytes = 19'000'000;
  }

  Json document() {
    report_.message = compose_message(measurement_);
    report_.warnings = list_warnings(measurement_, {});
    const std::string text = compose_document(report_);
    EXPECT_EQ(text.find('\n'), std::string::npos);
    return Json::parse(text);
  }

  SyntheticScene scene_;
  Measurement measurement_;
  MeasureReport report_;
};

std::vector<std::string> keys_of(const std::string& text) {
  std::vector<std::string> keys;
  const auto document = nlohmann::ordered_json::parse(text);
  for (const auto& [key, value] : document.items()) keys.push_back(key);
  return keys;
}

TEST_F(Report, DocumentHasEveryKeyOfTheContractInItsOrder) {
  document();
  EXPECT_EQ(keys_of(compose_document(report_)),
            (std::vector<std::string>{"version", "capture", "pair", "profile", "seed", "status", "message",
                                      "items", "relative_angle_deg", "pose", "timing_ms", "memory_bytes",
                                      "checks", "warnings"}));
}

TEST_F(Report, DocumentOfAMeasurement) {
  measurement_.warnings.raise(Warning::angle_small);
  measurement_.warnings.raise(Warning::item_uncertain, 3);
  const Json json = document();
  EXPECT_EQ(json["version"], 2);
  EXPECT_EQ(json["seed"], 18446744073709551615ULL);
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(
      json["items"],
      Json::parse(
          R"([{"label":2,"dish":1,"status":"ok","volume_ml":101.25,"sigma_ml":null,"column_volume_ml":101.25,"area_mm2":3500.0,
                             "mean_height_mm":29.0,"max_height_mm":31.5},
                            {"label":3,"dish":1,"status":"ok","volume_ml":22.5,"sigma_ml":null,"column_volume_ml":22.5,"area_mm2":1900.0,
                             "mean_height_mm":11.8,"max_height_mm":12.5}])"));
  EXPECT_EQ(json["relative_angle_deg"], 17.5);
  EXPECT_EQ(json["pose"]["rotation"], Json({1, 0, 0, 0, 1, 0, 0, 0, 1}));
  EXPECT_EQ(json["pose"]["translation_mm"], Json({120.0, 3.0, 25.0}));
  EXPECT_EQ(json["timing_ms"].size(), kStageCount + 2);
  EXPECT_EQ(json["timing_ms"]["stereo"], 10.0);
  EXPECT_EQ(json["timing_ms"]["total"], 91.0);
  EXPECT_EQ(json["timing_ms"]["setup"], 3.5);
  EXPECT_EQ(json["memory_bytes"], Json::parse(R"({"reserved":20000000,"used":19000000})"));
  ASSERT_EQ(json["warnings"].size(), 2U);
  EXPECT_EQ(json["warnings"][0], Json::parse(R"({"code":"angle_small","label":null,
                            "message":"The views lie less than 10 degrees apart; heights are uncertain."})"));
  EXPECT_EQ(json["warnings"][1]["code"], "item_uncertain");
  EXPECT_EQ(json["warnings"][1]["label"], 3);
}

TEST_F(Report, DocumentOfAPartialMeasurement) {
  std::vector<ItemResult> items(measurement_.items.begin(), measurement_.items.end());
  items[1].status = StatusCode::item_hidden;
  measurement_.items = items;
  measurement_.status = StatusCode::partial;
  const Json json = document();
  EXPECT_TRUE(is_measured(measurement_));
  EXPECT_EQ(json["status"], "partial");
  EXPECT_EQ(json["items"][0]["volume_ml"], 101.25);
  EXPECT_EQ(json["items"][1]["status"], "item_hidden");
  for (const char* key : {"volume_ml", "sigma_ml", "area_mm2", "mean_height_mm", "max_height_mm"}) {
    EXPECT_TRUE(json["items"][1][key].is_null()) << key;
  }
  const std::string message = json["message"];
  EXPECT_NE(message.find("1 of 2 items"), std::string::npos) << message;
  EXPECT_NE(message.find("Item 3: The item is not visible"), std::string::npos) << message;
}

TEST_F(Report, DocumentOfAFailedMeasurement) {
  measurement_ = {};
  measurement_.status = StatusCode::too_few_matches;
  measurement_.report.keypoints = {800, 750};
  measurement_.report.matches = 7;
  measurement_.stage_ms[static_cast<std::size_t>(Stage::features)] = 12.0;
  const Json json = document();
  EXPECT_FALSE(is_measured(measurement_));
  EXPECT_EQ(json["status"], "too_few_matches");
  EXPECT_EQ(json["items"], Json::array());
  EXPECT_TRUE(json["relative_angle_deg"].is_null());
  EXPECT_TRUE(json["pose"].is_null());
  EXPECT_EQ(json["timing_ms"]["features"], 12.0);
  EXPECT_TRUE(json["timing_ms"]["stereo"].is_null());
  const std::string message = json["message"];
  EXPECT_NE(message.find("800 and 750 keypoints, 7 matches"), std::string::npos) << message;
}

TEST_F(Report, DocumentStaysJsonWhateverTheNumbersAndPaths) {
  measurement_.relative_angle_deg = std::numeric_limits<double>::quiet_NaN();
  report_.capture = "dish \"\xff\n";
  const Json json = document();
  EXPECT_TRUE(json["relative_angle_deg"].is_null());
}

TEST_F(Report, EveryStatusHasItsNameAndSentence) {
  for (int code = 0; code <= static_cast<int>(StatusCode::item_textureless); ++code) {
    measurement_.status = static_cast<StatusCode>(code);
    const Json json = document();
    EXPECT_EQ(json["status"], name(static_cast<StatusCode>(code)));
    EXPECT_FALSE(json["message"].get<std::string>().empty());
    EXPECT_NE(compose_table(report_).find(name(static_cast<StatusCode>(code))), std::string::npos);
  }
}

TEST_F(Report, TableForPeople) {
  document();
  EXPECT_EQ(compose_table(report_),
            "capture  meals/m01, views 0 and 2, profile paper, seed 18446744073709551615\n"
            "status   ok: Measured.\n"
            "\n"
            "  item  volume ml   area cm²    mean mm     max mm  status\n"
            "     2      101.2       35.0       29.0       31.5  ok\n"
            "     3       22.5       19.0       11.8       12.5  ok\n"
            "   all      123.8\n"
            "\n"
            "views    17.5° apart, the camera moved by 123 mm\n"
            "points   0 of 0 and 0 of 0 salient points, 0 matches, 0 fit the motion, 0 lie on the card\n"
            "time     91.0 ms (image 10.0, features 10.0, matching 10.0, pose 10.0, scale 10.0, "
            "rectification 10.0, "
            "stereo 10.0, surface 10.0, volume 10.0; setup before it 3.5)\n"
            "memory   18.12 of 19.07 MiB used\n");
}

TEST_F(Report, TableOfAFailureHasNoNumbers) {
  measurement_ = {};
  measurement_.status = StatusCode::card_not_found;
  document();
  const std::string table = compose_table(report_);
  EXPECT_NE(table.find("card_not_found: The reference card"), std::string::npos) << table;
  EXPECT_EQ(table.find("volume ml"), std::string::npos) << table;
}

}  // namespace
}  // namespace traygauge
