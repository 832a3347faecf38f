#include "firmware/base/scan_id.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

namespace traygauge::test {
namespace {

TEST(ScanId, ReadsBackWhatItWrote) {
  for (const std::string station : {"a", "kitchen-2", "0", "s-1-2-3"}) {
    for (const std::uint64_t number : {std::uint64_t{1}, std::uint64_t{10}, std::uint64_t{20261127},
                                       std::numeric_limits<std::uint64_t>::max()}) {
      const ScanId id{station, number};
      EXPECT_EQ(parse_scan_id(scan_id_text(id)), id) << scan_id_text(id);
    }
  }
  EXPECT_EQ(scan_id_text({"kitchen-2", 17}), "kitchen-2-17");
}

TEST(ScanId, OneTextNamesAScan) {
  for (const char* const text :
       {"", "-", "17", "kitchen", "kitchen-", "-17", "kitchen-0", "kitchen-017", "kitchen-+1", "kitchen-1 ",
        "kitchen--1", "Kitchen-1", "kit chen-1", "kitchen/1", "kitchen-18446744073709551616", "a.b-1"}) {
    EXPECT_FALSE(parse_scan_id(text)) << "'" << text << "'";
  }
}

TEST(ScanId, AStationNameIsSafeInAddressesAndTopics) {
  EXPECT_TRUE(is_station_name("kitchen-2"));
  EXPECT_TRUE(is_station_name(std::string(32, 'x')));
  for (const std::string& name : {std::string(), std::string(33, 'x'), std::string("-a"), std::string("a-"),
                                  std::string("a/b"), std::string("a+"), std::string("a#"),
                                  std::string("\xc3\xa4"), std::string("a\0b", 3), std::string("A")}) {
    EXPECT_FALSE(is_station_name(name)) << "'" << name << "'";
  }
}

}  // namespace
}  // namespace traygauge::test
