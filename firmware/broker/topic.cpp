#include "firmware/broker/topic.hpp"

#include <algorithm>

namespace traygauge {
namespace {

constexpr std::string_view kVersion = "/v1/";
constexpr std::size_t kMaxPrefixCharacters = 64;

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

}  // namespace

bool is_topic_prefix(std::string_view text) {
  if (text.empty() || text.size() > kMaxPrefixCharacters) return false;
  if (text.front() == '/' || text.back() == '/' || text.find("//") != std::string_view::npos) return false;
  return std::all_of(text.begin(), text.end(), [](char c) { return is_plain(c) || c == '/'; });
}

std::string topic_level(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string level;
  for (const char c : text) {
    if (is_plain(c)) {
      level += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    level += '%';
    level += kDigits[byte >> 4U];
    level += kDigits[byte & 0xfU];
  }
  return level;
}

std::string topic_of(std::string_view prefix, std::string_view name, std::string_view what) {
  return std::string(prefix).append(kVersion).append(topic_level(name)).append("/").append(what);
}

std::optional<TopicParts> split_topic(std::string_view prefix, std::string_view topic) {
  if (!topic.starts_with(prefix)) return std::nullopt;
  topic.remove_prefix(prefix.size());
  if (!topic.starts_with(kVersion)) return std::nullopt;
  topic.remove_prefix(kVersion.size());
  const std::size_t slash = topic.find('/');
  if (slash == std::string_view::npos || slash == 0) return std::nullopt;
  const TopicParts parts{topic.substr(0, slash), topic.substr(slash + 1)};
  if (parts.what.find('/') != std::string_view::npos) return std::nullopt;
  return parts;
}

}  // namespace traygauge
