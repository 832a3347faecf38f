#include "firmware/config/station_writing.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <system_error>
#include <vector>

#include "firmware/base/toml_text.hpp"
#include "simulator/capture/output_file.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

std::string comment(const std::string& note) {
  std::string text;
  std::istringstream lines(note);
  for (std::string line; std::getline(lines, line);) text += "# " + line + "\n";
  return text;
}

std::string list(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + toml_number(number);
  return "[" + text + "]";
}

std::string without_indent(const std::string& line) {
  return line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
}

// A line such as "[lens]", spaces and a comment allowed.
bool opens_table(const std::string& line, const std::string& name) {
  std::string head = without_indent(line.substr(0, line.find('#')));
  std::erase_if(head, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
  return name.empty() ? head.starts_with("[") : head == "[" + name + "]";
}

bool is_blank_or_comment(const std::string& line) {
  const std::string rest = without_indent(line);
  return rest.empty() || rest.front() == '#' || rest.front() == '\r';
}

}  // namespace

std::string compose_lens_table(const std::string& name, const LensConfig& lens, const std::string& note) {
  const CameraDescription& camera = lens.camera;
  std::ostringstream text;
  text << "[" << name << "]\n"
       << comment(note) << "width = " << camera.size.width << "\nheight = " << camera.size.height
       << "\nfx = " << toml_number(camera.fx_px) << "\nfy = " << toml_number(camera.fy_px)
       << "\ncx = " << toml_number(camera.cx_px) << "\ncy = " << toml_number(camera.cy_px)
       << "\ndistortion = " << list(camera.coefficients()) << "\n";
  if (lens.focus) text << "focus = " << *lens.focus << "\n";
  if (!lens.calibrated_camera.empty()) text << "camera = " << toml_text(lens.calibrated_camera) << "\n";
  if (!lens.calibrated_on.empty()) text << "calibrated_on = " << toml_text(lens.calibrated_on) << "\n";
  if (lens.grade_percent) text << "grade_percent = " << toml_number(*lens.grade_percent) << "\n";
  return text.str();
}

std::string compose_arm_geometry_table(const ArmGeometry& geometry, const std::string& note) {
  return "[arm_geometry]\n" + comment(note) + "commanded_deg = " + toml_number(geometry.commanded_deg) +
         "\nturn_deg = " + list(geometry.turn_deg) + "\nshift_mm = " + list(geometry.shift_mm) + "\n";
}

// Comments right before the next table belong to that one.
std::string with_table(const std::string& text, const std::string& name, const std::string& table) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  const auto begin = std::find_if(lines.begin(), lines.end(),
                                  [&](const std::string& line) { return opens_table(line, name); });
  auto end = begin;
  if (begin != lines.end()) {
    end = std::find_if(begin + 1, lines.end(), [](const std::string& line) { return opens_table(line, ""); });
    while (end - 1 != begin && is_blank_or_comment(*(end - 1))) --end;
  }
  std::string result;
  for (auto line = lines.begin(); line != begin; ++line) result += *line + "\n";
  if (begin == lines.end() && !result.empty()) result += "\n";
  result += table;
  for (auto line = end; line != lines.end(); ++line) result += *line + "\n";
  return result;
}

void write_station_table(const fs::path& file, const std::string& name, const std::string& table) {
  read_station_file(file);
  std::ifstream stream(file, std::ios::binary);
  const std::string before((std::istreambuf_iterator<char>(stream)), {});
  const std::string after = with_table(before, name, table);
  const fs::path draft = file.string() + ".new";
  write_stream(draft, [&after](std::FILE* out) {
    return std::fwrite(after.data(), 1, after.size(), out) == after.size();
  });
  std::error_code error;
  try {
    read_station_file(draft);
  } catch (...) {
    fs::remove(draft, error);
    throw;
  }
  fs::rename(draft, file, error);
  if (error) throw OutputError(file, error.message());
}

}  // namespace traygauge
