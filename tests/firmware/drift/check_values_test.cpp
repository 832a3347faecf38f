#include "firmware/drift/check_values.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/firmware/store/sample_scan.hpp"

namespace traygauge::test {
namespace {

constexpr auto kScale = static_cast<std::size_t>(WatchedCheck::scale_percent);
constexpr auto kHeight = static_cast<std::size_t>(WatchedCheck::dish_height_mm);
constexpr auto kBlur = static_cast<std::size_t>(WatchedCheck::blur_px);

TEST(CheckValues, AreReadFromAStationsDocument) {
  SampleScan scan;
  scan.scale_percent = 0.25;
  scan.dish_height_mm = -0.5;
  scan.blur_px = {0.75, 1.25};
  const CheckValues values = read_check_values(sample_document(scan));
  EXPECT_EQ(values[kScale], 0.25);
  EXPECT_EQ(values[kHeight], -0.5);
  EXPECT_EQ(values[kBlur], 1.0);
}

TEST(CheckValues, OfGlazeAreOfDishesWhoseGlazeTellsItsHeight) {
  constexpr auto kGlaze = static_cast<std::size_t>(WatchedCheck::glaze_height_mm);
  EXPECT_EQ(read_check_values(R"({"checks":[{"name":"glaze_height_mm","label":1,"value":1.5},
                                            {"name":"glaze_height_mm","label":201,"value":0.5}]})")[kGlaze],
            1.0);
  EXPECT_EQ(read_check_values(R"({"checks":[{"name":"dish_height_mm","value":0.1}]})")[kGlaze], std::nullopt);
}

TEST(CheckValues, AnEarlierProgramsDocumentHasNone) {
  SampleScan scan;
  scan.has_checks = false;
  EXPECT_EQ(read_check_values(sample_document(scan)), CheckValues());
}

TEST(CheckValues, AreOneNumberAScan) {
  const auto scale = [](const std::string& values) {
    std::string checks;
    std::size_t begin = 0;
    while (begin < values.size()) {
      const std::size_t end = values.find(' ', begin);
      checks +=
          (checks.empty() ? R"({"name":"scale_percent","value":)" : R"(,{"name":"scale_percent","value":)") +
          values.substr(begin, end - begin) + "}";
      begin = end == std::string::npos ? end : end + 1;
    }
    return read_check_values("{\"checks\":[" + checks + "]}")[kScale];
  };
  EXPECT_EQ(scale("3"), 3.0);
  EXPECT_EQ(scale("1 5"), 3.0);
  EXPECT_EQ(scale("9 1 2"), 2.0);
  EXPECT_EQ(scale(""), std::nullopt);
}

TEST(CheckValues, OfOnePictureAreThatPictures) {
  EXPECT_EQ(read_check_values(R"({"blur_px":[null,0.9]})")[kBlur], 0.9);
  EXPECT_EQ(read_check_values(R"({"blur_px":[0.8,null]})")[kBlur], 0.8);
  EXPECT_EQ(read_check_values(R"({"blur_px":[null,null]})")[kBlur], std::nullopt);
  EXPECT_EQ(read_check_values(R"({"blur_px":[0,0.9]})")[kBlur], 0.9) << "0 says that nothing was measured";
}

// A document is what a station sent, and is stored whatever its checks are.
TEST(CheckValues, WhatIsNoMeasurementSaysNothing) {
  for (const std::string text :
       {"", "null", "[]", "{}", R"({"checks":null,"blur_px":null})", R"({"checks":{},"blur_px":{"a":1}})",
        R"({"checks":[1,"a",null,[],{}],"blur_px":["1",[],{},true]})",
        R"({"checks":[{"name":"scale_percent"},{"name":7,"value":1},{"value":1}]})",
        R"({"checks":[{"name":"scale_percent","value":"1"},{"name":"scale_percent","value":null}]})",
        R"({"checks":[{"name":"scale_percent","value":1e308}],"blur_px":[1e308,-1,1001]})"}) {
    EXPECT_EQ(read_check_values(text), CheckValues()) << text;
  }
}

}  // namespace
}  // namespace traygauge::test
