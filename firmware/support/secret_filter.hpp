// Takes secrets out of texts that somebody sends to others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace traygauge {

inline constexpr std::string_view kRemoved = "(removed)";

class SecretFilter {
 public:
  // `secret` is removed wherever it stands, also in base64, percent-encoded and as JSON escapes it. Fewer
  // than four characters are not: they stand in every other word.
  void add(std::string_view secret);
  // A file of tokens or another secret: the first word of each line, and all words of eight characters and
  // more.
  void add_file_content(std::string_view content);
  // An address's user, password, and what stands behind its host.
  void add_address(std::string_view address);

  // Beside what was added this removes what looks like a secret: "Bearer …", "token=…", "Cookie: …" and the
  // like, and of each address with "://" all but scheme, host and port.
  std::string clean(const std::string& text) const;

 private:
  void add_form(std::string form);
  std::size_t longest_form_at(std::string_view text, std::size_t at) const;  // 0: none stands there
  std::string without_forms(std::string_view text) const;

  std::unordered_map<std::uint32_t, std::vector<std::string>> forms_;  // by their first four bytes
};

}  // namespace traygauge
