#include "firmware/config/dish_file.hpp"

#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include "firmware/base/toml_text.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

std::string pair(double first, double second) {
  std::ostringstream text;
  text << '[' << toml_number(first) << ", " << toml_number(second) << ']';
  return text.str();
}

}  // namespace

std::string compose_dish_file(const DishDescription& dish) {
  std::ostringstream text;
  text << "# Lengths in mm, heights above the table.\nversion = 1\n";
  if (!dish.style.empty()) text << "style = " << toml_text(dish.style) << '\n';
  text << "outer_size_mm = " << pair(dish.outer_size_mm[0], dish.outer_size_mm[1]) << '\n';
  text << "rim_height_mm = " << toml_number(dish.rim_height_mm) << '\n';
  text << "bottom_height_mm = " << toml_number(dish.bottom_height_mm) << '\n';
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
