#include "tests/firmware/evaluate/xml_check.hpp"

#include <regex>
#include <vector>

namespace traygauge {
namespace {

bool has_bare_ampersand(const std::string& text) {
  static const std::regex entity("&(?!(amp|lt|gt|quot|apos);)");
  return std::regex_search(text, entity);
}

}  // namespace

std::string find_xml_fault(const std::string& document) {
  static const std::regex opening(R"re(<([A-Za-z]\w*)((?:\s+[A-Za-z][\w:-]*="[^"<]*")*)\s*(/?)>)re");
  const std::string declaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>";
  if (document.rfind(declaration, 0) != 0) return "no declaration";
  std::vector<std::string> open;
  int roots = 0;
  for (std::size_t at = declaration.size(); at < document.size();) {
    const std::size_t next = document.find('<', at);
    const std::string text = document.substr(at, next == std::string::npos ? next : next - at);
    if (has_bare_ampersand(text)) return "& in: " + text;
    if (open.empty() && text.find_first_not_of(" \n") != std::string::npos) return "text outside: " + text;
    if (next == std::string::npos) break;
    const std::size_t end = document.find('>', next);
    if (end == std::string::npos) return "unclosed tag";
    const std::string tag = document.substr(next, end + 1 - next);
    at = end + 1;
    std::smatch match;
    if (tag[1] == '/') {
      if (open.empty() || tag != "</" + open.back() + ">") return "unexpected " + tag;
      open.pop_back();
    } else if (!std::regex_match(tag, match, opening) || has_bare_ampersand(tag)) {
      return "not a tag: " + tag;
    } else {
      if (open.empty() && ++roots > 1) return "two roots";
      if (match[3].length() == 0) open.push_back(match[1]);
    }
  }
  if (roots == 0) return "no element";
  return open.empty() ? "" : "unclosed " + open.back();
}

}  // namespace traygauge
