#include "firmware/support/secret_filter.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace traygauge {
namespace {

constexpr std::size_t kMinSecretCharacters = 4;
constexpr std::size_t kMinWordCharacters = 8;

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

bool ends_value(char c) {
  return is_space(c) || std::string_view("\"'&;,<>(){}[]").find(c) != std::string_view::npos;
}

std::string base64(std::string_view bytes, std::string_view last_two) {
  std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
  digits += last_two;
  std::string text;
  std::uint32_t buffer = 0;
  unsigned bits = 0;
  for (const char byte : bytes) {
    buffer = (buffer << 8U) | static_cast<std::uint8_t>(byte);
    for (bits += 8; bits >= 6; bits -= 6) text += digits[(buffer >> (bits - 6)) & 63U];
  }
  return text;  // the bits at the end depend on what follows
}

std::string percent_encoded(std::string_view text, std::string_view hex, std::string_view kept) {
  std::string encoded;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (is_word(c) || kept.find(c) != std::string_view::npos) {
      encoded += c;
    } else {
      encoded += '%';
      encoded += hex[code / 16];
      encoded += hex[code % 16];
    }
  }
  return encoded;
}

std::string json_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::uint32_t first_bytes(std::string_view text) {
  std::uint32_t bytes = 0;
  for (std::size_t i = 0; i < kMinSecretCharacters; ++i)
    bytes = (bytes << 8U) | static_cast<std::uint8_t>(text[i]);
  return bytes;
}

// Of what stands behind "://": host and port.
std::string shown_address(std::string_view address) {
  const std::size_t path = std::min(address.find_first_of("/?#"), address.size());
  std::string_view authority = address.substr(0, path);
  // An '@' in the path may as well end a password with a '/': nobody knows which part is the host.
  if (address.find('@', path) != std::string_view::npos) return std::string(kRemoved);
  if (const std::size_t user_end = authority.rfind('@'); user_end != std::string_view::npos)
    authority.remove_prefix(user_end + 1);
  std::string shown(authority);
  if (path + 1 < address.size()) shown.append("/").append(kRemoved);
  return shown;
}

std::string without_address_parts(const std::string& text) {
  constexpr std::string_view kMark = "://";
  std::string result;
  std::size_t begin = 0;
  for (std::size_t at = text.find(kMark); at != std::string::npos; at = text.find(kMark, begin)) {
    const std::size_t host = at + kMark.size();
    std::size_t end = host;
    while (end < text.size() && !is_space(text[end]) && text[end] != '"' && text[end] != '\'' &&
           text[end] != '<' && text[end] != '>') {
      ++end;
    }
    result.append(text, begin, host - begin)
        .append(shown_address(std::string_view(text).substr(host, end - host)));
    begin = end;
  }
  return result.append(text, begin);
}

bool is_at(std::string_view text, std::size_t at, std::string_view lower) {
  if (text.size() - at < lower.size()) return false;
  return std::equal(
      lower.begin(), lower.end(), text.begin() + static_cast<std::ptrdiff_t>(at),
      [](char expected, char c) { return (c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c) == expected; });
}

std::size_t skip(std::string_view text, std::size_t at, std::string_view characters) {
  while (at < text.size() && characters.find(text[at]) != std::string_view::npos) ++at;
  return at;
}

// Where the secret begins that a word at `at` announces; 0: none does.
std::size_t value_after_word(std::string_view text, std::size_t at) {
  constexpr auto kSchemes = std::to_array<std::string_view>({"bearer", "bearer%20"});
  constexpr auto kNames =
      std::to_array<std::string_view>({"token", "password", "passwd", "passwort", "kennwort", "pwd", "secret",
                                       "api_key", "apikey", "api-key"});
  for (const std::string_view scheme : kSchemes) {
    if (!is_at(text, at, scheme)) continue;
    const std::size_t value = skip(text, at + scheme.size(), " \t:=\"'");
    if (value > at + scheme.size() || scheme.back() == '0') return value;
  }
  for (const std::string_view name : kNames) {
    if (!is_at(text, at, name)) continue;
    const std::size_t sign = skip(text, at + name.size(), " \t\"'");
    if (sign < text.size() && (text[sign] == '=' || text[sign] == ':')) return skip(text, sign + 1, " \t\"'");
    if (is_at(text, sign, "%3d")) return sign + 3;
  }
  return 0;
}

// A line of HTTP, of which nothing stays.
bool is_secret_header(std::string_view text, std::size_t at) {
  constexpr auto kHeaders =
      std::to_array<std::string_view>({"authorization:", "cookie:", "traygauge-signature:"});
  return std::any_of(kHeaders.begin(), kHeaders.end(),
                     [&](std::string_view name) { return is_at(text, at, name); });
}

std::string without_announced(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    // "webhook_secret = PATH" is a key of the station file, whose value was looked at already.
    const bool begins_word = at == 0 || (!is_word(text[at - 1]) && text[at - 1] != '_');
    if (begins_word && is_secret_header(text, at)) {
      const std::size_t colon = text.find(':', at);
      result.append(text, at, colon + 1 - at).append(" ").append(kRemoved);
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    const std::size_t value = begins_word ? value_after_word(text, at) : 0;
    std::size_t end = value;
    while (value != 0 && end < text.size() && !ends_value(text[end])) ++end;
    if (end > value) {
      result.append(text, at, value - at).append(kRemoved);
      at = end;
    } else {
      result += text[at++];
    }
  }
  return result;
}

}  // namespace

void SecretFilter::add_form(std::string form) {
  if (form.size() < kMinSecretCharacters) return;
  std::vector<std::string>& forms = forms_[first_bytes(form)];
  if (std::find(forms.begin(), forms.end(), form) == forms.end()) forms.push_back(std::move(form));
}

std::size_t SecretFilter::longest_form_at(std::string_view text, std::size_t at) const {
  if (text.size() - at < kMinSecretCharacters) return 0;
  const auto forms = forms_.find(first_bytes(text.substr(at)));
  if (forms == forms_.end()) return 0;
  std::size_t longest = 0;
  for (const std::string& form : forms->second) {
    if (form.size() > longest && text.substr(at).starts_with(form)) longest = form.size();
  }
  return longest;
}

// Secrets may overlap: what lies within one of them goes.
std::string SecretFilter::without_forms(std::string_view text) const {
  std::string result;
  std::size_t removed_until = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (const std::size_t length = longest_form_at(text, at); length > 0) {
      if (at >= removed_until) result += kRemoved;
      removed_until = std::max(removed_until, at + length);
    }
    if (at >= removed_until) result += text[at];
  }
  return result;
}

void SecretFilter::add(std::string_view secret) {
  if (secret.size() < kMinSecretCharacters) return;
  add_form(std::string(secret));
  add_form(json_escaped(secret));
  for (const std::string_view hex : {"0123456789ABCDEF", "0123456789abcdef"}) {
    for (const std::string_view kept : {"-._~", "-._~/", "-._~/+=:", "*-._"})
      add_form(percent_encoded(secret, hex, kept));
  }
  // Bytes before it shift its bits: of the first digits that they share, none counts.
  constexpr std::array<std::size_t, 3> kSharedDigits = {0, 2, 3};
  for (const std::string_view last_two : {"+/", "-_"}) {
    for (std::size_t before = 0; before < kSharedDigits.size(); ++before) {
      const std::string text = base64(std::string(before, '\0').append(secret), last_two);
      add_form(text.substr(kSharedDigits[before]));
    }
  }
}

void SecretFilter::add_file_content(std::string_view content) {
  bool begins_line = true;
  for (std::size_t at = 0; at < content.size();) {
    std::size_t end = at;
    while (end < content.size() && !is_space(content[end])) ++end;
    if (end > at) {
      if (begins_line || end - at >= kMinWordCharacters) add(content.substr(at, end - at));
      begins_line = false;
    } else {
      begins_line = begins_line || content[at] == '\n';
      ++end;
    }
    at = end;
  }
}

void SecretFilter::add_address(std::string_view address) {
  const std::size_t mark = address.find("://");
  if (mark == std::string_view::npos) return add(address);
  std::string_view rest = address.substr(mark + 3);
  if (const std::size_t at = rest.rfind('@'); at != std::string_view::npos) {
    const std::string_view user = rest.substr(0, at);
    add(user);
    // A short name of a user is often a host's, too.
    const std::size_t name_end = std::min(user.find(':'), user.size());
    if (name_end >= kMinWordCharacters) add(user.substr(0, name_end));
    add(user.substr(std::min(name_end + 1, user.size())));
    rest.remove_prefix(at + 1);
  }
  const std::size_t path = rest.find_first_of("/?#");
  if (path == std::string_view::npos) return;
  rest.remove_prefix(path);
  if (rest.size() >= kMinWordCharacters) add(rest);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of("/?#&="), rest.size());
    // "scans" and "token" are words that a log needs.
    if (end >= kMinWordCharacters) add(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

std::string SecretFilter::clean(const std::string& text) const {
  return without_announced(without_address_parts(without_forms(text)));
}

}  // namespace traygauge
