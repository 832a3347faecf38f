#include "firmware/verify/certificate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "firmware/evaluate/gnuplot.hpp"
#include "tests/firmware/verify/sample_record.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

std::string certificate_of(const VerifyRecord& record, char wanted) {
  return compose_certificate(record, verify_figures(record), *find_verify_class(std::string(1, wanted)));
}

TEST(Certificate, SaysPassOrFailAndTheStrictestClass) {
  const std::string good = certificate_of(large_record({0.5, -0.5}), 'C');
  EXPECT_NE(good.find("**PASS against class C"), std::string::npos) << good;
  EXPECT_NE(good.find("the strictest class that is reached is A"), std::string::npos);
  const std::string fair = certificate_of(large_record({2.9, 0.9}), 'A');
  EXPECT_NE(fair.find("**FAIL against class A"), std::string::npos) << fair;
  EXPECT_NE(fair.find("is reached is B"), std::string::npos);
  EXPECT_NE(fair.find("- The bias over all bodies may reach 2."), std::string::npos) << fair;
}

TEST(Certificate, HoldsConditionsFiguresAndRefusals) {
  VerifyRecord record = large_record({1.0, 2.0, 3.0});
  record.header.plan.bodies[0].volume_sigma_ml = 0.5;
  record.scans.push_back(refused_scan("body0-0"));
  const std::string text = certificate_of(record, 'C');
  for (const char* said :
       {"traygauge 1.2.3", "2026-11-27T07:40:12.345Z", "| camera | a \\| b |", "| temperature | 21 °C |",
        "| bias | +2.00 | +1.", "| body0 | 50.0 ± 0.5 | 6 |", "CV of 10 repeats", "refused, of 41 attempts",
        "- body0-0, attempt 1: card_not_found. The card was not found.", "OIML R 129", "errors.svg",
        "repeats.svg"})
    EXPECT_NE(text.find(said), std::string::npos) << said << "\n" << text;
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(Certificate, AnEmptyTestIsSaidToBeOne) {
  VerifyRecord record;
  record.header = sample_header();
  const std::string text = certificate_of(record, 'C');
  EXPECT_NE(text.find("0 of 10 steps are done"), std::string::npos) << text;
  EXPECT_NE(text.find("no class is reached"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(Certificate, ListsEachAttemptAsARow) {
  VerifyRecord record = large_record({1.0});
  record.scans.push_back(refused_scan("body0-0"));
  const std::string csv = compose_scans_csv(record);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 42);
  const auto columns = [](const std::string& line) { return std::ranges::count(line, ','); };
  std::istringstream lines(csv);
  std::string head;
  std::getline(lines, head);
  for (std::string line; std::getline(lines, line);) EXPECT_EQ(columns(line), columns(head)) << line;
  EXPECT_NE(csv.find("body0-1,body0,0,middle,0.0,0,1,2026-11-27T07:41:00.000Z,ok,50.000,0.000,50.500,1.000,"
                     "1.000,2.000,"),
            std::string::npos)
      << csv;
}

TEST(Certificate, WritesItsFilesWithPlots) {
  const TemporaryFolder folder;
  const std::string config = TRAYGAUGE_SOURCE_DIR "/config";
  std::ostringstream log;
  VerifyRecord empty;
  empty.header = sample_header();
  for (const auto& [name, record] :
       {std::pair{"full", large_record({1.0, -2.0, 0.5})}, std::pair{"empty", empty}}) {
    const fs::path out = folder.path() / name;
    write_certificate(out, record, verify_figures(record), kVerifyClasses[0], config, log);
    EXPECT_EQ(log.str(), "");
    EXPECT_NE(read_text(out / "certificate.md").find("# Acceptance test"), std::string::npos);
    const bool is_full = std::string(name) == "full";
    for (const char* plot : {"errors.svg", "repeats.svg"}) {
      const std::string svg = read_text(out / plot);
      EXPECT_NE(svg.find("</svg>"), std::string::npos) << plot;
      EXPECT_EQ(svg.find("No data") == std::string::npos, is_full) << plot;
    }
    if (is_full) {
      EXPECT_NE(read_text(out / "errors.svg").find("30 scans"), std::string::npos);
      EXPECT_NE(read_text(out / "errors.svg").find("body4"), std::string::npos);
      EXPECT_NE(read_text(out / "repeats.svg").find("10 repeats"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace traygauge
