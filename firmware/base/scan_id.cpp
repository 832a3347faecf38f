#include "firmware/base/scan_id.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>

namespace traygauge {

bool is_station_name(std::string_view name) {
  constexpr std::size_t kMaxCharacters = 32;
  if (name.empty() || name.size() > kMaxCharacters || name.front() == '-' || name.back() == '-') return false;
  return std::all_of(name.begin(), name.end(), [](char character) {
    return (character >= 'a' && character <= 'z') || (character >= '0' && character <= '9') ||
           character == '-';
  });
}

std::string scan_id_text(const ScanId& id) {
  return id.station + "-" + std::to_string(id.number);
}

std::optional<ScanId> parse_scan_id(std::string_view text) {
  const std::size_t dash = text.rfind('-');
  if (dash == std::string_view::npos || !is_station_name(text.substr(0, dash))) return std::nullopt;
  const std::string_view digits = text.substr(dash + 1);
  ScanId id;
  id.station = text.substr(0, dash);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), id.number);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  // One text a scan: "01" names none, and scans count from 1.
  if (digits.front() == '0') return std::nullopt;
  return id;
}

}  // namespace traygauge
