#include "firmware/handover/next_tray.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

// As many as labels can tell apart; see core's kMaxItems.
constexpr int kMaxFoods = 198;
constexpr std::size_t kMaxDishes = 8;  // see core's kMaxPlacedDishes
constexpr std::int64_t kLongestMs = 3'600'000;
constexpr std::size_t kMaxTrayBytes = 64;

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) {
    if (!all.empty()) all += ", ";
    all += text;
  }
  return all;
}

Expected<std::vector<std::string>> read_dishes(const Json& json,
                                               const std::vector<std::string>& dish_styles) {
  std::vector<std::string> dishes;
  if (json.is_null()) return dishes;
  if (!json.is_array()) return Failure{"dishes: expected a list of styles"};
  for (const Json& dish : json) {
    const bool is_known =
        dish.is_string() && std::count(dish_styles.begin(), dish_styles.end(), dish.get<std::string>()) > 0;
    if (!is_known && dish_styles.empty())
      return Failure{"dishes: expected none, because this station plays captures, which bring theirs"};
    if (!is_known) return Failure{"dishes: expected some of " + joined(dish_styles)};
    dishes.push_back(dish.get<std::string>());
  }
  if (dishes.size() > kMaxDishes) return Failure{"dishes: expected at most " + std::to_string(kMaxDishes)};
  return dishes;
}

Json value_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found == json.end() ? Json() : *found;
}

}  // namespace

Expected<ToldTray> read_told_tray(const std::string& text, const std::vector<std::string>& dish_styles) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return Failure{"expected a JSON object, found something else"};
  ToldTray told;
  const Json tray = value_of(json, "tray");
  const bool is_name = tray.is_string() && tray.get<std::string>().size() <= kMaxTrayBytes;
  if (!tray.is_null() && !is_name)
    return Failure{"tray: expected a text of at most " + std::to_string(kMaxTrayBytes) + " bytes"};
  if (is_name) told.hint.tray = tray.get<std::string>();
  const Json foods = value_of(json, "foods");
  if (!foods.is_null() && (!foods.is_number_unsigned() || foods < 1 || foods > kMaxFoods))
    return Failure{"foods: expected a whole number from 1 to " + std::to_string(kMaxFoods)};
  if (!foods.is_null()) told.hint.foods = foods.get<int>();
  Expected<std::vector<std::string>> dishes = read_dishes(value_of(json, "dishes"), dish_styles);
  if (!dishes.ok()) return Failure{dishes.failure()};
  told.hint.dishes = std::move(*dishes);
  const Json valid = value_of(json, "valid_ms");
  if (!valid.is_number_unsigned() || valid > kLongestMs)
    return Failure{"valid_ms: expected a whole number from 0 to " + std::to_string(kLongestMs)};
  told.valid_for = std::chrono::milliseconds(valid.get<std::int64_t>());
  return told;
}

std::string told_tray_json(const ToldTray& told) {
  const Json json = {{"tray", told.hint.tray.empty() ? Json() : Json(told.hint.tray)},
                     {"foods", told.hint.foods > 0 ? Json(told.hint.foods) : Json()},
                     {"dishes", told.hint.dishes},
                     {"valid_ms", told.valid_for.count()}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void NextTray::tell(const ToldTray& told, Time now) {
  hint_ = told.valid_for > std::chrono::milliseconds::zero() ? std::optional(told.hint) : std::nullopt;
  valid_until_ = now + told.valid_for;
  is_in_use_ = false;
}

TrayHint NextTray::use(Time now) {
  std::optional<ToldTray> told = at(now);
  is_in_use_ = told.has_value();
  return told ? std::move(told->hint) : TrayHint();
}

void NextTray::use_ended(bool is_measured) {
  if (is_in_use_ && is_measured) hint_.reset();
  is_in_use_ = false;
}

std::optional<ToldTray> NextTray::at(Time now) const {
  if (!hint_ || now >= valid_until_) return std::nullopt;
  return ToldTray{*hint_, std::chrono::ceil<std::chrono::milliseconds>(valid_until_ - now)};
}

}  // namespace traygauge
