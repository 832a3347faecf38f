#include "firmware/config/station_writing.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
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

// A line such as "device = …".
bool sets_key(const std::string& line, const std::string& key) {
  const std::string rest = without_indent(line);
  if (!rest.starts_with(key)) return false;
  const std::size_t next = rest.find_first_not_of(" \t", key.size());
  return next != std::string::npos && rest[next] == '=';
}

// The '#' behind a value; npos without one. Strings of our keys hold no escaped quotes.
std::size_t find_comment(const std::string& line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote == 0 && line[i] == '#') return i;
    if (quote == 0 && (line[i] == '"' || line[i] == '\'')) {
      quote = line[i];
    } else if (line[i] == quote) {
      quote = 0;
    }
  }
  return std::string::npos;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text.append(line).append("\n");
  return text;
}

// Where a key is set, in a table of its own. Keys of ours that programs write have their values on one line.
struct KeyPlace {
  std::vector<std::string>::iterator table;  // the end of all lines: it is not there
  std::vector<std::string>::iterator line;   // `end`: the key is not there
  std::vector<std::string>::iterator end;    // of the table
};

KeyPlace find_key(std::vector<std::string>& lines, const std::string& name, const std::string& key) {
  const auto opens = [](const std::string& table) {
    return [&table](const std::string& line) { return opens_table(line, table); };
  };
  const std::string any;
  const auto table = std::find_if(lines.begin(), lines.end(), opens(name));
  if (table == lines.end()) return {table, table, table};
  const auto end = std::find_if(table + 1, lines.end(), opens(any));
  const auto line =
      std::find_if(table + 1, end, [&](const std::string& text) { return sets_key(text, key); });
  return {table, line, end};
}

// The file as `change` makes it of what it holds, whole or not at all.
void rewrite(const fs::path& file, const std::function<std::string(const std::string&)>& change) {
  read_station_file(file);
  std::ifstream stream(file, std::ios::binary);
  const std::string before((std::istreambuf_iterator<char>(stream)), {});
  const std::string after = change(before);
  const fs::path draft = file.string() + ".new";
  write_stream(draft, [&after](std::FILE* out) {
    return std::fwrite(after.data(), 1, after.size(), out) == after.size();
  });
  std::error_code error;
  try {
    read_station_file(file, draft);
  } catch (...) {
    fs::remove(draft, error);
    throw;
  }
  fs::rename(draft, file, error);
  if (error) throw OutputError(file, error.message());
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
  const std::vector<std::string> lines = lines_of(text);
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

// A comment behind the old value stays.
std::string with_value(const std::string& text, const std::string& name, const std::string& key,
                       const std::string& value) {
  std::vector<std::string> lines = lines_of(text);
  const std::string setting = key + " = " + value;
  const KeyPlace place = find_key(lines, name, key);
  if (place.table == lines.end()) {
    if (!lines.empty()) lines.emplace_back();
    lines.push_back("[" + name + "]");
    lines.push_back(setting);
  } else if (place.line == place.end) {
    lines.insert(place.table + 1, setting);
  } else {
    const std::size_t comment = find_comment(*place.line);
    *place.line = setting + (comment == std::string::npos ? "" : "  " + place.line->substr(comment));
  }
  return joined(lines);
}

std::string without_value(const std::string& text, const std::string& name, const std::string& key) {
  std::vector<std::string> lines = lines_of(text);
  const KeyPlace place = find_key(lines, name, key);
  if (place.line != place.end) lines.erase(place.line);
  return joined(lines);
}

void write_station_table(const fs::path& file, const std::string& name, const std::string& table) {
  rewrite(file, [&](const std::string& text) { return with_table(text, name, table); });
}

void write_station_value(const fs::path& file, const std::string& name, const std::string& key,
                         const std::string& value) {
  rewrite(file, [&](const std::string& text) { return with_value(text, name, key, value); });
}

void remove_station_value(const fs::path& file, const std::string& name, const std::string& key) {
  rewrite(file, [&](const std::string& text) { return without_value(text, name, key); });
}

}  // namespace traygauge
