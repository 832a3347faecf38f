#include "firmware/drift/check_values.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "firmware/drift/median_estimate.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

// Ten times what any of the values may be: 100 %, or a picture or tray of another world.
constexpr double kMaxMagnitude = 1000.0;

std::optional<double> possible_number(const Json& json) {
  if (!json.is_number()) return std::nullopt;
  const auto number = json.get<double>();
  return std::abs(number) <= kMaxMagnitude ? std::optional(number) : std::nullopt;
}

std::optional<double> median_of(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(estimate_median(values).value);
}

std::optional<double> median_of_check(const Json& checks, WatchedCheck wanted) {
  std::vector<double> values;
  for (const Json& check : checks) {
    if (!check.is_object() || !check.contains("value") || check.value("name", Json()) != name(wanted))
      continue;
    if (const auto value = possible_number(check["value"])) values.push_back(*value);
  }
  return median_of(values);
}

std::optional<double> median_blur(const Json& pictures) {
  std::vector<double> values;
  for (const Json& picture : pictures) {
    const auto blur_px = possible_number(picture);
    if (blur_px && *blur_px > 0.0) values.push_back(*blur_px);
  }
  return median_of(values);
}

}  // namespace

CheckValues read_check_values(std::string_view document) {
  CheckValues values;
  const Json json = Json::parse(document, nullptr, false);
  if (!json.is_object()) return values;
  if (const auto checks = json.find("checks"); checks != json.end() && checks->is_array()) {
    for (const auto check :
         {WatchedCheck::scale_percent, WatchedCheck::dish_height_mm, WatchedCheck::glaze_height_mm})
      values[static_cast<std::size_t>(check)] = median_of_check(*checks, check);
  }
  if (const auto blurs = json.find("blur_px"); blurs != json.end() && blurs->is_array())
    values[static_cast<std::size_t>(WatchedCheck::blur_px)] = median_blur(*blurs);
  return values;
}

}  // namespace traygauge
