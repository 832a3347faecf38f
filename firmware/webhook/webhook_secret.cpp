#include "firmware/webhook/webhook_secret.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "firmware/base/secret_file.hpp"

namespace traygauge {

Expected<std::string> read_webhook_secret(const std::filesystem::path& file) {
  constexpr std::size_t kMinCharacters = 20;
  constexpr std::size_t kMaxCharacters = 128;
  Expected<std::string> secret = read_secret_file(file.string(), "a secret");
  if (!secret.ok()) return secret;
  while (secret->ends_with('\n') || secret->ends_with('\r')) secret->pop_back();
  const bool is_visible =
      std::all_of(secret->begin(), secret->end(), [](char c) { return c > ' ' && c < '\x7f'; });
  if (is_visible && secret->size() >= kMinCharacters && secret->size() <= kMaxCharacters) return secret;
  return Failure{file.string() + ": expected one line of " + std::to_string(kMinCharacters) + " to " +
                 std::to_string(kMaxCharacters) + " characters without spaces, found " +
                 (is_visible ? std::to_string(secret->size()) : "others") +
                 "; make one with: head -c 24 /dev/urandom | base64"};
}

Expected<void> check_certificates(const std::filesystem::path& file) {
  constexpr std::size_t kMaxBytes = 4UL * 1024 * 1024;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return Failure{file.string() + ": cannot be read: " + std::system_category().message(errno)};
  std::string text(kMaxBytes, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.find("-----BEGIN CERTIFICATE-----") != std::string::npos) return {};
  return Failure{file.string() + ": expected certificates in PEM, found none"};
}

}  // namespace traygauge
