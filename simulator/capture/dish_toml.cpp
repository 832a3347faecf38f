#include "simulator/capture/dish_toml.hpp"

#include <array>
#include <cstddef>
#include <string_view>

#include "simulator/capture/toml_file.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxDishBytes = std::size_t{1} << 16U;
constexpr int kDishFileVersion = 1;
constexpr std::array<std::string_view, 6> kKeys = {
    "version", "style", "outer_size_mm", "rim_height_mm", "bottom_height_mm", "profile"};

}  // namespace

DishDescription read_dish_file(const std::filesystem::path& file) {
  const JsonDocument document = read_toml(file, kMaxDishBytes, "a dish in TOML");
  const JsonNode root = document.root();
  check_file_version(root, kDishFileVersion, "dish file");
  expect_keys(root, kKeys);
  return read_dish(root);
}

}  // namespace traygauge
