#include "firmware/support/station_name.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>

#include "firmware/base/file_descriptor.hpp"
#include "firmware/support/station_values.hpp"

namespace traygauge {
namespace {

std::size_t after_blanks(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(" \t", at), text.size());
}

bool opens_station_table(std::string_view line) {
  std::string head(line.substr(0, line.find('#')));
  std::erase_if(head, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
  return head == "[station]";
}

// Of `name = "kitchen"`: where the name begins, and its length; a length of 0: the line is another one.
std::pair<std::size_t, std::size_t> find_name(std::string_view line) {
  constexpr std::string_view kKey = "name";
  const std::size_t key = after_blanks(line, 0);
  if (!line.substr(key).starts_with(kKey)) return {0, 0};
  const std::size_t sign = after_blanks(line, key + kKey.size());
  if (sign >= line.size() || line[sign] != '=') return {0, 0};
  const std::size_t quote = after_blanks(line, sign + 1);
  if (quote >= line.size() || (line[quote] != '"' && line[quote] != '\'')) return {0, 0};
  const std::size_t end = line.find(line[quote], quote + 1);
  return end == std::string_view::npos ? std::pair{quote, std::size_t{0}}
                                       : std::pair{quote + 1, end - quote - 1};
}

// By the reader of station files, which takes files.
std::vector<StationValue> values_of(const std::string& text) {
  const FileDescriptor file(::memfd_create("station", MFD_CLOEXEC));
  if (!file.is_open() ||
      ::write(file.number(), text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    return {};
  const StationValues station = read_station_values("/proc/self/fd/" + std::to_string(file.number()));
  return station.problem.empty() ? station.values : std::vector<StationValue>();
}

// A line within a text of several lines may look like the one that is meant.
bool differ_in_name_alone(const std::string& before, const std::string& after, const std::string& name) {
  const std::vector<StationValue> old_values = values_of(before);
  const std::vector<StationValue> new_values = values_of(after);
  bool has_name = false;
  const auto is_as_meant = [&](const StationValue& old_value, const StationValue& new_value) {
    const bool is_name = new_value.key == "station.name";
    has_name = has_name || is_name;
    return old_value.key == new_value.key && new_value.text == (is_name ? name : old_value.text);
  };
  return std::equal(old_values.begin(), old_values.end(), new_values.begin(), new_values.end(),
                    is_as_meant) &&
         has_name;
}

}  // namespace

Expected<std::string> with_station_name(const std::string& text, const std::string& name) {
  bool is_in_station = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    if (line.substr(after_blanks(line, 0)).starts_with('[')) is_in_station = opens_station_table(line);
    if (const auto [at, length] = find_name(line); is_in_station && length > 0) {
      std::string renamed = text;
      renamed.replace(begin + at, length, name);
      if (differ_in_name_alone(text, renamed, name)) return renamed;
      break;
    }
    begin = end + 1;
  }
  return Failure{"the station file has no line name = \"…\" below [station], so its name cannot be changed"};
}

}  // namespace traygauge
