#include "firmware/base/time_zone.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <system_error>

#include "firmware/base/wall_clock.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr const char* kZones = "/usr/share/zoneinfo";

// No way out of the folder of zones, and nothing that the C library reads as a rule instead of a name.
bool is_zone_name(const std::string& name) {
  const auto may_stand = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
           c == '_' || c == '-' || c == '+';
  };
  return !name.empty() && name.front() != '/' && std::all_of(name.begin(), name.end(), may_stand);
}

}  // namespace

Expected<void> set_time_zone(const std::string& name) {
  std::error_code ignored;
  if (!is_zone_name(name) || !fs::is_regular_file(fs::path(kZones) / name, ignored))
    return Failure{"expected a name below " + std::string(kZones) + " such as Europe/Berlin, found \"" +
                   name + "\"; is the package tzdata installed?"};
  const std::string zone = ":" + name;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): before threads start
  ::setenv("TZ", zone.c_str(), 1);
  ::tzset();
  return {};
}

std::string machine_time_zone() {
  std::error_code ignored;
  const fs::path zone = fs::weakly_canonical("/etc/localtime", ignored);
  const fs::path name = zone.lexically_relative(kZones);
  const bool is_below = !name.empty() && *name.begin() != "..";
  return is_below ? name.string() : std::string();
}

std::string local_text(std::int64_t unix_ms) {
  constexpr std::int64_t kMsPerS = 1000;
  unix_ms = std::clamp(unix_ms, std::int64_t{0}, kEndOf9999Ms);
  const auto seconds = static_cast<std::time_t>(unix_ms / kMsPerS);
  std::tm local{};
  ::localtime_r(&seconds, &local);
  const auto offset_min = static_cast<int>(local.tm_gmtoff / 60);
  const int distance_min = std::abs(offset_min);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02d-%02dT%02d:%02d:%02d.%03d%c%02d:%02d",
                local.tm_year + 1900, local.tm_mon + 1, local.tm_mday, local.tm_hour, local.tm_min,
                local.tm_sec, static_cast<int>(unix_ms % kMsPerS), offset_min < 0 ? '-' : '+',
                distance_min / 60, distance_min % 60);
  return text.data();
}

}  // namespace traygauge
