#include "simulator/capture/json_flaw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace traygauge {
namespace {

constexpr std::size_t kShownBytes = 24;
constexpr const char* kFinite = "numbers must be finite";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' || c == '-' ||
         c == '.' || c == '_';
}

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

// The place of `at`, and no word about it yet.
JsonFlaw flaw_at(std::string_view text, std::size_t at) {
  JsonFlaw flaw;
  for (const char c : text.substr(0, at)) {
    const bool continues = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;  // of a character in UTF-8
    if (!continues) ++flaw.column;
    if (c == '\n') {
      ++flaw.line;
      flaw.column = 1;
    }
  }
  return flaw;
}

JsonFlaw flaw_at(std::string_view text, std::size_t at, std::string found, std::string hint) {
  JsonFlaw flaw = flaw_at(text, at);
  flaw.found = std::move(found);
  flaw.hint = std::move(hint);
  return flaw;
}

// From `at` to the word's end, or one character.
std::string_view word_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_word(text[end])) ++end;
  return text.substr(at, std::min(std::max(end - at, std::size_t{1}), kShownBytes));
}

std::string_view rest_of_line(std::string_view text, std::size_t at) {
  return text.substr(at, std::min(text.find_first_of("\r\n", at), at + kShownBytes) - at);
}

std::size_t last_before(std::string_view text, std::size_t at) {
  while (at > 0 && is_space(text[at - 1])) --at;
  return at == 0 ? std::string_view::npos : at - 1;
}

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_utf16(std::string_view text) {
  if (text.size() < 2) return false;
  return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") || text[0] == '\0' || text[1] == '\0';
}

// A comma that somebody wrote for a decimal point: the parser took what stands before it for a number.
bool is_decimal_comma(std::string_view text, std::size_t at) {
  return at >= 2 && is_digit(text[at]) && text[at - 1] == ',' && is_digit(text[at - 2]);
}

JsonFlaw describe_decimal_comma(std::string_view text, std::size_t at) {
  std::size_t begin = at - 1;
  while (begin > 0 && is_word(text[begin - 1])) --begin;
  std::string number(text.substr(begin, at - begin));
  number += word_at(text, at);
  std::string mended = number;
  std::replace(mended.begin(), mended.end(), ',', '.');
  return flaw_at(text, begin, number, "write a decimal point: " + mended);
}

JsonFlaw describe_word(std::string_view text, std::size_t at) {
  constexpr std::array<std::string_view, 11> not_finite = {
      "NaN", "nan", "-NaN", "-nan", "Infinity", "-Infinity", "infinity", "inf", "-inf", "Inf", "-Inf"};
  constexpr std::array<std::string_view, 5> capitals = {"True", "False", "None", "TRUE", "FALSE"};
  const std::string_view word = word_at(text, at);
  const char c = text[at];
  if (c == '/' || c == '#') {
    return flaw_at(text, at, "the comment " + std::string(rest_of_line(text, at)),
                   "JSON has no comments: remove it");
  }
  if (is_one_of(word, not_finite)) return flaw_at(text, at, std::string(word), kFinite);
  if (is_one_of(word, capitals)) return flaw_at(text, at, std::string(word), "write true, false or null");
  if (c == '\'') return flaw_at(text, at, "a single quote", "put keys and texts in double quotes");
  if (static_cast<unsigned char>(c) >= 0x80U) {
    return flaw_at(text, at, "a byte that is no UTF-8, or a sign that belongs in quotes",
                   "save the file as UTF-8");
  }
  if (c == '\n' || c == '\r') return flaw_at(text, at, "the end of the line", "close the quote before it");
  return flaw_at(text, at, std::string(word), "check commas, quotes and brackets there");
}

}  // namespace

JsonFlaw describe_json_flaw(std::string_view text, std::size_t byte) {
  if (is_utf16(text)) return flaw_at(text, 0, "UTF-16", "save the file as UTF-8");
  if (last_before(text, text.size()) == std::string_view::npos) {
    return flaw_at(text, 0, "an empty file", "write the document, or copy the file again");
  }
  if (byte == 0 || byte > text.size()) {
    return flaw_at(text, text.size(), "the end of the file", "close all brackets and quotes");
  }
  std::size_t at = byte - 1;
  while (at > 0 && is_word(text[at]) && is_word(text[at - 1])) --at;
  if (is_decimal_comma(text, at)) return describe_decimal_comma(text, at);
  if (text[at] == '}' || text[at] == ']') {
    const std::size_t before = last_before(text, at);
    if (before != std::string_view::npos && text[before] == ',') {
      return flaw_at(text, before, "a comma before " + std::string(1, text[at]), "remove that comma");
    }
  }
  // Of a character that is no UTF-8 the parser has read one byte more.
  const auto is_ascii = [&](std::size_t i) { return static_cast<unsigned char>(text[i]) < 0x80U; };
  if (text[at] == '"' && at > 0 && !is_ascii(at - 1)) --at;
  const std::size_t slash = at > 0 && text[at - 1] == '/' ? at - 1 : at;  // the parser may have read one more
  return describe_word(text, slash);
}

JsonFlaw describe_number_overflow(std::string_view text) {
  bool in_string = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (in_string && text[at] == '\\') {
      ++at;
    } else if (text[at] == '"') {
      in_string = !in_string;
    } else if (!in_string && is_word(text[at])) {
      std::size_t end = at;
      while (end < text.size() && is_word(text[end])) ++end;
      const std::string number(text.substr(at, end - at));
      if ((is_digit(number[0]) || number[0] == '-') && std::isinf(std::strtod(number.c_str(), nullptr))) {
        return flaw_at(text, at, number.substr(0, kShownBytes), kFinite);
      }
      at = end - 1;
    }
  }
  return flaw_at(text, 0, "a number that is too large", kFinite);
}

}  // namespace traygauge
