#include "firmware/webhook/signature.hpp"

#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <stdexcept>

namespace traygauge {
namespace {

constexpr std::size_t kDigestBytes = 32;

// OpenSSL counts bytes of text as unsigned char.
const unsigned char* bytes_of(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

}  // namespace

std::string hmac_sha256_hex(std::string_view secret, std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (HMAC(EVP_sha256(), secret.data(), static_cast<int>(secret.size()), bytes_of(text), text.size(),
           digest.data(), &size) == nullptr ||
      size != kDigestBytes)
    throw std::runtime_error("OpenSSL forms no HMAC-SHA256");
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hex;
  for (std::size_t i = 0; i < kDigestBytes; ++i) {
    hex += kDigits[digest.at(i) / 16U];
    hex += kDigits[digest.at(i) % 16U];
  }
  return hex;
}

std::string webhook_signature(std::string_view secret, std::int64_t unix_s, std::string_view body) {
  const std::string time = std::to_string(unix_s);
  return "t=" + time + ",v1=" + hmac_sha256_hex(secret, time + "." + std::string(body));
}

}  // namespace traygauge
