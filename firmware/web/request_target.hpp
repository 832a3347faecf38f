// What a request asks for: the path and the query of its first line, decoded.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/base/expected.hpp"

namespace traygauge {

using NamedText = std::pair<std::string, std::string>;
using NamedTexts = std::vector<NamedText>;

// The first text of that name, or null.
const std::string* find_text(const NamedTexts& texts, std::string_view name);

struct RequestTarget {
  std::vector<std::string> segments;  // of "/api/v1/scans": three; of "/": none
  bool is_folder = false;             // the path ends in '/'
  NamedTexts query;                   // in their order, names may repeat
};

// Decodes once. Refuses what no honest client sends: "..", empty segments, encoded '/' and '\', control
// characters, bytes that are not UTF-8, more than 64 segments or parameters.
Expected<RequestTarget> parse_target(std::string_view text);

// "/kitchen/scales" or "/kitchen/scales/", under which a proxy shows the hub; "" and "/": under none.
Expected<std::vector<std::string>> parse_base_path(std::string_view text);

// "/api/v1/scans": the segments joined, for messages and comparison.
std::string path_text(const std::vector<std::string>& segments);

bool is_utf8(std::string_view text);

}  // namespace traygauge
