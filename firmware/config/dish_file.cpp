#include "firmware/config/dish_file.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

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
