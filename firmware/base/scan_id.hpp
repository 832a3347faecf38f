// The name of one scan, the same in journal, store, page and broker.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace traygauge {

// Unique as long as no two stations of a site share a name and no station counts a number twice.
struct ScanId {
  std::string station;       // see is_station_name()
  std::uint64_t number = 0;  // from 1; goes on counting over restarts

  friend bool operator==(const ScanId&, const ScanId&) = default;
  friend auto operator<=>(const ScanId&, const ScanId&) = default;
};

// 1 to 32 of a-z, 0-9 and '-', with no '-' at either end: safe in file names, addresses and broker topics.
bool is_station_name(std::string_view name);

// "kitchen-2-17"; parse_scan_id() reads it back. None where the text is no such name.
std::string scan_id_text(const ScanId& id);
std::optional<ScanId> parse_scan_id(std::string_view text);

}  // namespace traygauge
