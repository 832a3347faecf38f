#include "tests/firmware/evaluate/svg_check.hpp"

#include <regex>
#include <string_view>
#include <vector>

namespace traygauge {
namespace {

constexpr std::string_view kSpace = " \t\n";

bool has_bare_ampersand(const std::string& text) {
  static const std::regex entity("&(?!(amp|lt|gt|quot|apos);)");
  return std::regex_search(text, entity);
}

void skip_space(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
}

std::string take_name(std::string_view& text) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_:-";
  const std::size_t length = std::min(text.find_first_not_of(letters), text.size());
  const std::string name(text.substr(0, length));
  text.remove_prefix(length);
  return name;
}

// name="value" or name='value', and spaces about it.
bool take_attribute(std::string_view& text) {
  if (take_name(text).empty()) return false;
  skip_space(text);
  if (!text.starts_with('=')) return false;
  text.remove_prefix(1);
  skip_space(text);
  if (!text.starts_with('"') && !text.starts_with('\'')) return false;
  const std::size_t end = text.find(text.front(), 1);
  if (end == std::string_view::npos || text.substr(0, end).find('<') != std::string_view::npos) return false;
  text.remove_prefix(end + 1);
  skip_space(text);
  return true;
}

// Of the tag that opens an element, its name; empty: it is no such tag. Not with a regular expression, which
// std::regex would follow so deep for a long path that the stack ends.
std::string name_of_opening(std::string_view tag) {
  tag.remove_prefix(1);
  tag.remove_suffix(tag.ends_with("/>") ? 2 : 1);
  const std::string name = take_name(tag);
  skip_space(tag);
  while (!tag.empty()) {
    if (!take_attribute(tag)) return "";
  }
  return name;
}

struct OpenElements {
  std::vector<std::string> names;
  int roots = 0;

  std::string take(const std::string& tag) {
    if (tag.starts_with("</")) {
      if (names.empty() || tag != "</" + names.back() + ">") return "unexpected " + tag;
      names.pop_back();
      return "";
    }
    const std::string name = name_of_opening(tag);
    if (name.empty() || has_bare_ampersand(tag)) return "not a tag: " + tag;
    if (names.empty() && (++roots > 1 || name != "svg")) return "not the root: " + tag;
    if (!tag.ends_with("/>")) names.push_back(name);
    return "";
  }
};

}  // namespace

std::string find_svg_fault(const std::string& document) {
  if (!document.starts_with("<?xml version=\"1.0\"")) return "no declaration";
  OpenElements open;
  for (std::size_t at = document.find("?>") + 2; at < document.size();) {
    const std::size_t next = std::min(document.find('<', at), document.size());
    const std::string text = document.substr(at, next - at);
    if (has_bare_ampersand(text)) return "& in: " + text;
    if (open.names.empty() && text.find_first_not_of(kSpace) != std::string::npos)
      return "text outside: " + text;
    if (next == document.size()) break;
    const std::size_t end = document.find('>', next);
    if (end == std::string::npos) return "unclosed tag";
    const std::string fault = open.take(document.substr(next, end + 1 - next));
    if (!fault.empty()) return fault;
    at = end + 1;
  }
  if (open.roots == 0) return "no element";
  return open.names.empty() ? "" : "unclosed " + open.names.back();
}

std::size_t count_in_curve(const std::string& document, int curve, const std::string& part) {
  const auto start_of = [&](int number) {
    return document.find("<g id=\"gnuplot_plot_" + std::to_string(number) + "\"");
  };
  const std::size_t end = std::min(start_of(curve + 1), document.size());
  std::size_t count = 0;
  for (std::size_t at = document.find(part, start_of(curve)); at < end; at = document.find(part, at + 1))
    ++count;
  return count;
}

}  // namespace traygauge
