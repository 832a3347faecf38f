#include "firmware/base/csv_fields.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace traygauge {
namespace {

TEST(CsvFields, AreQuotedWhereRfc4180AsksForIt) {
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("rice; red 'n' white"), "rice; red 'n' white");
  EXPECT_EQ(csv_field("rice, red"), "\"rice, red\"");
  EXPECT_EQ(csv_field("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csv_field("\""), "\"\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_field("a\rb"), "\"a\rb\"");
}

TEST(CsvFields, OfUndefinedNumbersAreBlank) {
  EXPECT_EQ(csv_number(1.25, 3), "1.250");
  EXPECT_EQ(csv_number(-0.5, 1), "-0.5");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN(), 3), "");
  EXPECT_EQ(csv_number(std::optional<double>(), 2), "");
  EXPECT_EQ(csv_number(std::optional(2.0), 2), "2.00");
}

}  // namespace
}  // namespace traygauge
