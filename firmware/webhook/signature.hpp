// How a receiver knows that a message is the hub's.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace traygauge {

// HMAC-SHA256 (RFC 2104) in lower-case hexadecimal digits.
std::string hmac_sha256_hex(std::string_view secret, std::string_view text);

// "t=UNIX_SECONDS,v1=HEX": the time is signed with the body, so that a receiver can refuse old messages that
// somebody sends again.
std::string webhook_signature(std::string_view secret, std::int64_t unix_s, std::string_view body);

}  // namespace traygauge
