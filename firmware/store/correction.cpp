#include "firmware/store/correction.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

namespace traygauge {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxBytes = 65'536;

Json document(const RenameItem& action) {
  return {{"action", "rename"}, {"item", action.item}, {"food", action.food}};
}

Json document(const MergeItems& action) {
  return {{"action", "merge"}, {"item", action.item}, {"others", action.others}};
}

Json document(const SplitItem& action) {
  return {{"action", "split"},
          {"item", action.item},
          {"volume_ml", action.volume_ml},
          {"food", action.food.empty() ? Json(nullptr) : Json(action.food)}};
}

Json document(const MarkItemWrong& action) {
  return {{"action", "item_wrong"}, {"item", action.item}};
}

Json document(const MarkScanWrong&) {
  return {{"action", "scan_wrong"}};
}

Json document(const UndoCorrection& action) {
  return {{"action", "undo"}, {"number", action.number}};
}

std::optional<int> as_int(const Json& value) {
  if (!value.is_number_integer() || value.is_number_float()) return std::nullopt;
  constexpr std::int64_t kMax = std::numeric_limits<int>::max();
  const auto number = value.get<std::int64_t>();
  if (number < 0 || number > kMax) return std::nullopt;
  return static_cast<int>(number);
}

// Reads the keys of an action; `problem` names the first that is not as expected.
struct ActionReader {
  const Json& json;
  std::string problem;

  void refuse(const char* key, const char* expected) {
    if (problem.empty()) problem = std::string("key ") + key + ": expected " + expected;
  }
  const Json& find(const char* key) const {
    static const Json nothing;
    const auto found = json.find(key);
    return found == json.end() ? nothing : *found;
  }
  int whole_number(const char* key) {
    const std::optional<int> number = as_int(find(key));
    if (!number) refuse(key, "a whole number");
    return number.value_or(0);
  }
  std::vector<int> whole_numbers(const char* key) {
    std::vector<int> numbers;
    const Json& list = find(key);
    if (!list.is_array()) refuse(key, "a list of whole numbers");
    if (!list.is_array()) return numbers;
    for (const Json& value : list) {
      const std::optional<int> number = as_int(value);
      if (!number) refuse(key, "a list of whole numbers");
      numbers.push_back(number.value_or(0));
    }
    return numbers;
  }
  double number(const char* key) {
    const Json& value = find(key);
    if (value.is_number()) return value.get<double>();
    refuse(key, "a number");
    return 0.0;
  }
  std::string text(const char* key) {
    const Json& value = find(key);
    if (value.is_string()) return value.get<std::string>();
    refuse(key, "text");
    return {};
  }
  std::string optional_text(const char* key) { return find(key).is_null() ? std::string() : text(key); }
};

}  // namespace

std::string correction_json(const CorrectionAction& action) {
  const Json json = std::visit([](const auto& kind) { return document(kind); }, action);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Expected<CorrectionAction> parse_correction(std::string_view json) {
  const Json action_json = json.size() > kMaxBytes ? Json() : Json::parse(json, nullptr, false);
  if (!action_json.is_object()) return Failure{"a correction is a JSON object of at most 65536 bytes"};
  ActionReader read{action_json, {}};
  const std::string kind = read.text("action");
  CorrectionAction action;
  if (kind == "rename") {
    action = RenameItem{read.whole_number("item"), read.text("food")};
  } else if (kind == "merge") {
    action = MergeItems{read.whole_number("item"), read.whole_numbers("others")};
  } else if (kind == "split") {
    action = SplitItem{read.whole_number("item"), read.number("volume_ml"), read.optional_text("food")};
  } else if (kind == "item_wrong") {
    action = MarkItemWrong{read.whole_number("item")};
  } else if (kind == "scan_wrong") {
    action = MarkScanWrong{};
  } else if (kind == "undo") {
    action = UndoCorrection{read.whole_number("number")};
  } else {
    read.refuse("action", "rename, merge, split, item_wrong, scan_wrong or undo");
  }
  if (!read.problem.empty()) return Failure{read.problem};
  return action;
}

}  // namespace traygauge
