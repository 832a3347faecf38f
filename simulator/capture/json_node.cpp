#include "simulator/capture/json_node.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxShownCharacters = 40;

std::string describe(const nlohmann::json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  if (value.is_null()) return "null";
  using Json = nlohmann::json;
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (value.is_number_float() && !std::isfinite(value.get<double>())) text = "not a finite number";
  if (text.size() > kMaxShownCharacters) text = text.substr(0, kMaxShownCharacters) + "...";
  return text;
}

std::string format(double number) {
  std::ostringstream stream;
  stream << number;
  return stream.str();
}

}  // namespace

JsonNode::JsonNode(const nlohmann::json& value, const JsonOrigin& origin, std::string key)
    : value_(&value), origin_(&origin), key_(std::move(key)) {}

int JsonNode::line() const {
  const auto found = origin_->lines.find(key_);
  return found == origin_->lines.end() ? 0 : found->second;
}

void JsonNode::fail(const std::string& expected, const std::string& hint) const {
  throw InputError(InputProblem{origin_->file, key_, expected, describe(*value_), hint, line()});
}

void JsonNode::require_object() const {
  if (!value_->is_object()) fail("an object {...}", "see the description of a capture");
}

std::optional<JsonNode> JsonNode::find(const char* name) const {
  require_object();
  const auto found = value_->find(name);
  if (found == value_->end()) return std::nullopt;
  return JsonNode(*found, *origin_, key_.empty() ? name : key_ + "." + name);
}

JsonNode JsonNode::member(const char* name) const {
  const std::optional<JsonNode> found = find(name);
  if (found) return *found;
  const std::string key = key_.empty() ? name : key_ + "." + name;
  throw InputError(InputProblem{origin_->file, key, "this key", "nothing", "add it", line()});
}

std::vector<JsonNode> JsonNode::elements(std::size_t min_count, std::size_t max_count) const {
  const std::size_t count = value_->size();
  if (!value_->is_array() || count < min_count || count > max_count) {
    const std::string least = std::to_string(min_count);
    fail(min_count == max_count ? "an array of " + least
                                : "an array of " + least + " to " + std::to_string(max_count),
         "correct the number of elements");
  }
  std::vector<JsonNode> nodes;
  nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    nodes.emplace_back((*value_)[i], *origin_, key_ + "[" + std::to_string(i) + "]");
  }
  return nodes;
}

std::vector<std::string> JsonNode::names() const {
  require_object();
  std::vector<std::string> names;
  for (const auto& [name, value] : value_->items()) names.push_back(name);
  return names;
}

double JsonNode::number(NumberRange range) const {
  const double number =
      value_->is_number() ? value_->get<double>() : std::numeric_limits<double>::quiet_NaN();
  if (!(number >= range.min && number <= range.max)) {
    fail("a number from " + format(range.min) + " to " + format(range.max), "correct the value");
  }
  return number;
}

double JsonNode::positive_number(double max) const {
  const double number = value_->is_number() ? value_->get<double>() : 0.0;
  if (!(number > 0.0 && number <= max)) {
    fail("a number above 0, at most " + format(max), "correct the value");
  }
  return number;
}

int JsonNode::integer(int min, int max) const {
  // A number beyond int64 is kept by the library as unsigned or as a float: out of any range of ours.
  const bool signed_range =
      value_->is_number_integer() &&
      (!value_->is_number_unsigned() ||
       value_->get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<int>::max()));
  const std::int64_t number =
      signed_range ? value_->get<std::int64_t>() : std::numeric_limits<std::int64_t>::min();
  if (number < min || number > max) {
    fail(min == max ? "the whole number " + std::to_string(min)
                    : "a whole number from " + std::to_string(min) + " to " + std::to_string(max),
         "correct the value");
  }
  return static_cast<int>(number);
}

bool JsonNode::is_text() const {
  return value_->is_string();
}

bool JsonNode::is_object() const {
  return value_->is_object();
}

bool JsonNode::is_list() const {
  return value_->is_array();
}

bool JsonNode::is_empty() const {
  return value_->empty();
}

bool JsonNode::truth() const {
  if (!value_->is_boolean()) fail("true or false", "correct the value");
  return value_->get<bool>();
}

std::string JsonNode::text() const {
  std::string text = value_->is_string() ? value_->get<std::string>() : std::string();
  if (text.empty()) fail("a text that is not empty", "put it in quotes");
  return text;
}

std::vector<double> JsonNode::nested_numbers(std::size_t min_count, std::size_t max_count,
                                             NumberRange range) const {
  std::vector<double> numbers;
  for (const JsonNode& element : elements(min_count, max_count)) {
    if (!element.is_list()) {
      numbers.push_back(element.number(range));
      continue;
    }
    for (const JsonNode& inner : element.elements(min_count, max_count))
      numbers.push_back(inner.number(range));
  }
  return numbers;
}

std::vector<double> JsonNode::numbers(std::size_t count, NumberRange range) const {
  std::vector<double> numbers;
  for (const JsonNode& element : elements(count, count)) numbers.push_back(element.number(range));
  return numbers;
}

JsonDocument::JsonDocument(JsonOrigin origin, nlohmann::json value)
    : origin_(std::move(origin)), value_(std::make_shared<const nlohmann::json>(std::move(value))) {}

std::string JsonDocument::dump() const {
  return value_->dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace traygauge
