#include "firmware/web/request_target.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace traygauge {
namespace {

constexpr std::size_t kMaxParts = 64;

std::optional<unsigned> hex_digit(char character) {
  if (character >= '0' && character <= '9') return static_cast<unsigned>(character - '0');
  if (character >= 'a' && character <= 'f') return static_cast<unsigned>(character - 'a') + 10;
  if (character >= 'A' && character <= 'F') return static_cast<unsigned>(character - 'A') + 10;
  return std::nullopt;
}

bool is_control(char character) {
  const auto code = static_cast<unsigned char>(character);
  return code < 0x20 || code == 0x7f;
}

// None where the escapes are broken or hide a control character, or where the result is not UTF-8.
std::optional<std::string> decode(std::string_view text, bool plus_is_space) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    char character = text[i];
    if (character == '%') {
      if (text.size() - i < 3) return std::nullopt;
      const auto high = hex_digit(text[i + 1]);
      const auto low = hex_digit(text[i + 2]);
      if (!high || !low) return std::nullopt;
      character = static_cast<char>(*high * 16 + *low);
      i += 2;
    } else if (plus_is_space && character == '+') {
      character = ' ';
    }
    if (is_control(character)) return std::nullopt;
    decoded += character;
  }
  if (!is_utf8(decoded)) return std::nullopt;
  return decoded;
}

// Calls `take(part)` for each part between separators until it returns false.
template <class Take>
bool for_each_part(std::string_view text, char separator, Take take) {
  for (;;) {
    const std::size_t end = text.find(separator);
    if (!take(text.substr(0, end))) return false;
    if (end == std::string_view::npos) return true;
    text.remove_prefix(end + 1);
  }
}

bool is_segment(const std::string& segment) {
  return !segment.empty() && segment != "." && segment != ".." &&
         segment.find_first_of("/\\") == std::string::npos;
}

bool decode_path(std::string_view path, RequestTarget& target) {
  path.remove_prefix(1);
  if (path.empty()) return true;
  if (path.back() == '/') {
    target.is_folder = true;
    path.remove_suffix(1);
  }
  return for_each_part(path, '/', [&target](std::string_view part) {
    auto segment = decode(part, false);
    if (!segment || !is_segment(*segment) || target.segments.size() == kMaxParts) return false;
    target.segments.push_back(std::move(*segment));
    return true;
  });
}

bool decode_query(std::string_view query, RequestTarget& target) {
  return for_each_part(query, '&', [&target](std::string_view part) {
    if (part.empty()) return true;
    const std::size_t equals = part.find('=');
    auto name = decode(part.substr(0, equals), true);
    auto value = equals == std::string_view::npos ? std::string() : decode(part.substr(equals + 1), true);
    if (!name || !value || target.query.size() == kMaxParts) return false;
    target.query.emplace_back(std::move(*name), std::move(*value));
    return true;
  });
}

// The count of bytes of the character that begins with `lead`, and the least code that needs so many.
struct Utf8Form {
  std::size_t bytes = 0;
  unsigned bits = 0;
  unsigned min_code = 0;
};

std::optional<Utf8Form> utf8_form(unsigned lead) {
  if (lead < 0x80) return Utf8Form{1, lead, 0};
  if (lead >= 0xC0 && lead < 0xE0) return Utf8Form{2, lead & 0x1FU, 0x80};
  if (lead >= 0xE0 && lead < 0xF0) return Utf8Form{3, lead & 0x0FU, 0x800};
  if (lead >= 0xF0 && lead < 0xF8) return Utf8Form{4, lead & 0x07U, 0x10000};
  return std::nullopt;
}

}  // namespace

const std::string* find_text(const NamedTexts& texts, std::string_view name) {
  const auto found =
      std::find_if(texts.begin(), texts.end(), [name](const NamedText& text) { return text.first == name; });
  return found == texts.end() ? nullptr : &found->second;
}

Expected<RequestTarget> parse_target(std::string_view text) {
  const std::size_t question = text.find('?');
  const std::string_view path = text.substr(0, question);
  RequestTarget target;
  if (path.empty() || path.front() != '/') return Failure{"expected a path that begins with '/'"};
  if (!decode_path(path, target))
    return Failure{"the path has an empty segment, '.', '..', or a broken or forbidden escape"};
  if (question != std::string_view::npos && !decode_query(text.substr(question + 1), target))
    return Failure{"the query has a broken or forbidden escape, or too many parameters"};
  return target;
}

Expected<std::vector<std::string>> parse_base_path(std::string_view text) {
  if (text.empty()) return std::vector<std::string>();
  Expected<RequestTarget> target = parse_target(text);
  if (target.ok() && target->query.empty() && text.find('?') == std::string_view::npos)
    return std::move(target->segments);
  return Failure{"expected a path such as /kitchen/scales, found " + std::string(text)};
}

std::string path_text(const std::vector<std::string>& segments) {
  std::string path;
  for (const std::string& segment : segments) path += "/" + segment;
  return path.empty() ? "/" : path;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto form = utf8_form(static_cast<unsigned char>(text[i]));
    if (!form || text.size() - i < form->bytes) return false;
    unsigned code = form->bits;
    for (std::size_t k = 1; k < form->bytes; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xC0U) != 0x80U) return false;
      code = (code << 6U) | (next & 0x3FU);
    }
    const bool is_surrogate = code >= 0xD800 && code < 0xE000;
    if (code < form->min_code || code > 0x10FFFF || is_surrogate) return false;
    i += form->bytes;
  }
  return true;
}

}  // namespace traygauge
