// What a caliper may say of a card, and what is made of it.
#include "firmware/card/measured_card.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

// Why it is refused; empty where it is taken.
std::string refusal_of(const std::string& measured) {
  try {
    read_measured_card(measured);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(MeasuredCard, IsReadInMillimetres) {
  const MeasuredCard plain = read_measured_card("84.9x53.6");
  EXPECT_DOUBLE_EQ(plain.width_mm, 84.9);
  EXPECT_DOUBLE_EQ(plain.height_mm, 53.6);
  EXPECT_FALSE(plain.thickness_mm);
  const MeasuredCard commas = read_measured_card("85,45X53,9x0,95");
  EXPECT_DOUBLE_EQ(commas.width_mm, 85.45);
  EXPECT_DOUBLE_EQ(commas.height_mm, 53.9);
  EXPECT_DOUBLE_EQ(*commas.thickness_mm, 0.95);
}

TEST(MeasuredCard, WrongSizesAreExplained) {
  struct Case {
    std::string measured;
    std::string reason;
  };
  const Case cases[] = {
      {"83.0x52.4", "97 %: printed with 'fit to page'"},
      {"80.5x50.8", "94 %: printed with 'fit to page'"},
      {"84.0x52.97", "98 %: printed with 'fit to page'"},
      {"89.0x56.1", "104 %: enlarged"},
      {"85.6x52.4", "100 % across but 97 % down"},
      {"88.2x54.0", "103 % across but 100 % down"},
      {"53.98x85.6", "the width comes first"},
      {"8.56x5.4", "centimetres"},
      {"3.37x2.13", "inches"},
      {"40x20", "expected about 85.60x53.98"},
      {"856x539.8", "expected about 85.60x53.98"},
      {"85.6x53.98x0.01", "thickness of 0.05 to 3 mm"},
      {"85.6x53.98x8", "thickness of 0.05 to 3 mm"},
      {"85.6", "expected WIDTHxHEIGHT"},
      {"85.6x", "expected WIDTHxHEIGHT"},
      {"x53.98", "expected WIDTHxHEIGHT"},
      {"85.6x53.98x1x1", "expected WIDTHxHEIGHT"},
      {"85.6*53.98", "expected WIDTHxHEIGHT"},
      {"85.6x53.98 mm", "expected WIDTHxHEIGHT"},
      {"nanx53.98", "expected WIDTHxHEIGHT"},
      {"infxinf", "expected WIDTHxHEIGHT"},
      {"-85.6x-53.98", "expected WIDTHxHEIGHT"},
      {"0x0", "expected WIDTHxHEIGHT"},
      {"85.6e0x53.98", "expected WIDTHxHEIGHT"},
      {"\n", "expected WIDTHxHEIGHT"},
  };
  for (const Case& wrong : cases) {
    const std::string refusal = refusal_of(wrong.measured);
    EXPECT_NE(refusal.find(wrong.reason), std::string::npos) << wrong.measured << ": " << refusal;
    EXPECT_EQ(refusal.find("--measured "), 0U) << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
  }
}

// What a print at 100 % may come out as is taken, beyond the limit nothing is.
TEST(MeasuredCard, LimitIsThatOfAHealthyPrint) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> inside(-kMaxScaleOff + 1e-3, kMaxScaleOff - 1e-3);
  std::uniform_real_distribution<double> outside(kMaxScaleOff + 1e-3, 0.25);
  for (int i = 0; i < 200; ++i) {
    const std::string good =
        fixed(85.6 * (1.0 + inside(random)), 2) + "x" + fixed(53.98 * (1.0 + inside(random)), 2);
    EXPECT_EQ(refusal_of(good), "") << good;
    const double off = i % 2 == 0 ? outside(random) : -outside(random);
    const std::string bad =
        i % 4 < 2 ? fixed(85.6 * (1.0 + off), 3) + "x53.98" : "85.6x" + fixed(53.98 * (1.0 + off), 3);
    EXPECT_NE(refusal_of(bad), "") << bad;
  }
}

TEST(MeasuredCard, LinesHaveTheMeasuredSize) {
  const std::string lines = compose_card_lines(read_measured_card("84.9x53.6x0.95"));
  EXPECT_NE(lines.find("[card]\npattern = \"card.png\"\nwidth_mm = 84.90\nheight_mm = 53.60\nthickness_mm = "
                       "0.95\n"),
            std::string::npos)
      << lines;
  EXPECT_NE(lines.find("\"card\": {\"pattern\": \"card.png\", \"width_mm\": 84.90, \"height_mm\": 53.60, "
                       "\"thickness_mm\": 0.95}"),
            std::string::npos)
      << lines;
}

TEST(MeasuredCard, StretchAndMissingThicknessAreTold) {
  const std::string even = describe_print(read_measured_card("84.9x53.6x0.95"));
  EXPECT_NE(even.find("99.2 % as wide and 99.3 % as high"), std::string::npos) << even;
  EXPECT_EQ(even.find("stretches"), std::string::npos) << even;
  EXPECT_EQ(even.find("THICKNESS"), std::string::npos) << even;
  const std::string uneven = describe_print(read_measured_card("85.6x53.5"));
  EXPECT_NE(uneven.find("100.0 % as wide and 99.1 % as high"), std::string::npos) << uneven;
  EXPECT_NE(uneven.find("stretches"), std::string::npos) << uneven;
  EXPECT_NE(uneven.find("THICKNESS"), std::string::npos) << uneven;
}

}  // namespace
}  // namespace traygauge
