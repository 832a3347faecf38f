// Where a webhook's receiver is.
#pragma once

#include <string>
#include <string_view>

#include "firmware/base/expected.hpp"

namespace traygauge {

struct WebhookAddress {
  std::string text;           // as it was written: may hold secrets
  std::string shown;          // scheme, host and port: what logs and pages may say
  bool is_encrypted = false;  // https
  bool is_local = false;      // this machine itself
};

inline constexpr const char* kExpectedWebhookAddress = R"(an address such as "https://till.example/scans")";

// http or https. The failure says what was found in place of kExpectedWebhookAddress, without repeating the
// text.
Expected<WebhookAddress> parse_webhook_address(std::string_view text);

}  // namespace traygauge
