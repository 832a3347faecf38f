#include "firmware/config/dish_library.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>

#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/input_error.hpp"

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

}  // namespace

std::filesystem::path find_config_folder(const std::string& named) {
  std::error_code ignored;
  if (!named.empty()) {
    if (std::filesystem::is_directory(named, ignored)) return named;
    throw InputError({named, "--config"}, "a folder", "none", "name the folder that holds dishes/");
  }
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* place : {"config", "../config", "../share/traygauge/config"}) {
    std::filesystem::path folder = (program / place).lexically_normal();
    if (std::filesystem::is_directory(folder / "dishes", ignored)) return folder;
  }
  throw InputError({program / "config", ""}, "the folder with dishes/, because the capture names no dish",
                   "none beside the program", "pass --config DIR or set TRAYGAUGE_CONFIG");
}

std::vector<DishDescription> read_dish_library(const std::filesystem::path& config_folder) {
  const std::filesystem::path folder = config_folder / "dishes";
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == ".toml") files.push_back(entry->path());
  }
  if (error) throw InputError({folder, ""}, "a folder with dishes", error.message(), "check the path");
  if (files.empty())
    throw InputError({folder, ""}, "a *.toml for every dish", "none", "describe at least one");
  std::sort(files.begin(), files.end());
  std::vector<DishDescription> dishes;
  dishes.reserve(files.size());
  for (const std::filesystem::path& file : files) dishes.push_back(read_dish_file(file));
  return dishes;
}

}  // namespace traygauge
