#include "simulator/capture/toml_file.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

// Keys as a JsonNode names them: "camera.gain", "trays.dishes[1]".
nlohmann::json to_json(const toml::node& node, const std::string& key, std::map<std::string, int>& lines) {
  if (node.source().begin) lines[key] = static_cast<int>(node.source().begin.line);
  if (const auto* table = node.as_table()) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& [name, value] : *table) {
      std::string below = key.empty() ? std::string() : key + ".";
      below += name.str();
      object[std::string(name.str())] = to_json(value, below, lines);
    }
    return object;
  }
  if (const auto* array = node.as_array()) {
    nlohmann::json list = nlohmann::json::array();
    for (const toml::node& value : *array) {
      std::string element = key;
      element.append("[").append(std::to_string(list.size())).append("]");
      list.push_back(to_json(value, element, lines));
    }
    return list;
  }
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* integer = node.as_integer()) return integer->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* truth = node.as_boolean()) return truth->get();
  return nullptr;
}

}  // namespace

JsonDocument read_toml(const std::filesystem::path& file, std::size_t max_bytes, const char* expected) {
  const InputFile input{file, ""};
  const std::vector<std::uint8_t> bytes = read_bytes(input, max_bytes, expected);
  try {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    JsonOrigin origin{file, {}};
    nlohmann::json value = to_json(toml::parse(text), "", origin.lines);
    return {std::move(origin), std::move(value)};
  } catch (const toml::parse_error& error) {
    const auto line = static_cast<int>(error.source().begin.line);
    throw InputError(InputProblem{file, "", expected, std::string(error.description()),
                                  "correct line " + std::to_string(line), line});
  }
}

void check_file_version(const JsonNode& root, int newest, const char* what) {
  const auto version = root.find("version");
  if (!version) return;
  const int found = version->integer(1, std::numeric_limits<int>::max());
  if (found <= newest) return;
  const std::string known = newest == 1 ? "version 1" : "version 1 to " + std::to_string(newest);
  version->fail(
      known + " of a " + what + ", which this program knows",
      "a newer program wrote this file: install that one again, or write the file as this one knows it");
}

void expect_keys(const JsonNode& table, std::span<const std::string_view> keys) {
  for (const std::string& name : table.names()) {
    if (std::find(keys.begin(), keys.end(), name) != keys.end()) continue;
    std::string list;
    for (const std::string_view key : keys) list += (list.empty() ? "one of " : ", ") + std::string(key);
    table.member(name.c_str()).fail(list, "correct the key");
  }
}

}  // namespace traygauge
