#include "firmware/config/dish_file.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 16U;
constexpr std::array<std::string_view, 5> kKeys = {"style", "outer_size_mm", "rim_height_mm",
                                                   "bottom_height_mm", "profile"};

// The same values as JSON, so that dishes are read and checked by one reader.
nlohmann::json to_json(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& [key, value] : *table) object[std::string(key.str())] = to_json(value);
    return object;
  }
  if (const auto* array = node.as_array()) {
    nlohmann::json list = nlohmann::json::array();
    for (const toml::node& value : *array) list.push_back(to_json(value));
    return list;
  }
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* integer = node.as_integer()) return integer->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* truth = node.as_boolean()) return truth->get();
  return nullptr;  // dates: no key of ours takes one
}

nlohmann::json read_toml(const std::filesystem::path& file) {
  const InputFile input{file, ""};
  const std::vector<std::uint8_t> bytes = read_bytes(input, kMaxFileBytes, "a dish in TOML");
  try {
    return to_json(toml::parse(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())));
  } catch (const toml::parse_error& error) {
    throw InputError(input, "a dish in TOML", std::string(error.description()),
                     "correct line " + std::to_string(error.source().begin.line));
  }
}

// The shortest decimal that reads back as the same number, with a point: TOML keeps integers apart.
std::string number(double value) {
  std::array<char, 64> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  std::string text(digits.data(), end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string pair(double first, double second) {
  std::ostringstream text;
  text << '[' << number(first) << ", " << number(second) << ']';
  return text.str();
}

// A basic string of TOML, whatever the text holds.
std::string quoted(const std::string& text) {
  constexpr const char* kHex = "0123456789abcdef";
  std::string basic = "\"";
  for (const char character : text) {
    const auto code = static_cast<unsigned char>(character);
    if (code < 0x20 || code == 0x7f) {
      basic += std::string("\\u00") + kHex[code / 16] + kHex[code % 16];
    } else {
      if (character == '"' || character == '\\') basic += '\\';
      basic += character;
    }
  }
  return basic + "\"";
}

}  // namespace

DishDescription read_dish_file(const std::filesystem::path& file) {
  const nlohmann::json document = read_toml(file);
  const JsonNode root(document, file);
  for (const std::string& name : root.names()) {
    if (std::find(kKeys.begin(), kKeys.end(), name) != kKeys.end()) continue;
    root.member(name.c_str())
        .fail("one of style, outer_size_mm, rim_height_mm, bottom_height_mm, profile", "correct the key");
  }
  return read_dish(root);
}

std::string compose_dish_file(const DishDescription& dish) {
  std::ostringstream text;
  text << "# Lengths in mm, heights above the table.\n";
  if (!dish.style.empty()) text << "style = " << quoted(dish.style) << '\n';
  text << "outer_size_mm = " << pair(dish.outer_size_mm[0], dish.outer_size_mm[1]) << '\n';
  text << "rim_height_mm = " << number(dish.rim_height_mm) << '\n';
  text << "bottom_height_mm = " << number(dish.bottom_height_mm) << '\n';
  if (dish.profile.empty()) return text.str();
  text << "# The inner surface: [inset from the outer edge, height], from the edge inward down to the flat "
          "bottom.\nprofile = ";
  const char* separator = "[";
  for (const ProfilePoint& point : dish.profile) {
    text << separator << pair(point.inset_mm, point.height_mm);
    separator = ", ";
  }
  text << "]\n";
  return text.str();
}

void write_dish_file(const std::filesystem::path& file, const DishDescription& dish) {
  const std::filesystem::path unfinished = file.string() + ".new";
  std::ofstream stream(unfinished, std::ios::binary);
  stream << compose_dish_file(dish);
  stream.close();
  std::error_code problem;
  if (!stream) problem.assign(errno != 0 ? errno : EIO, std::generic_category());
  if (!problem) std::filesystem::rename(unfinished, file, problem);
  if (!problem) return;
  std::error_code ignored;
  std::filesystem::remove(unfinished, ignored);
  throw OutputError(file, problem.message());
}

}  // namespace traygauge
