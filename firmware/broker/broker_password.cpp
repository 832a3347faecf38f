#include <algorithm>

#include "firmware/base/secret_file.hpp"
#include "firmware/broker/broker_link.hpp"

namespace traygauge {

Expected<std::string> read_broker_password(const BrokerConfig& config) {
  constexpr std::size_t kMaxCharacters = 256;
  const std::string key = config.table + ".password_file: ";
  Expected<std::string> password = read_secret_file(config.password_file->string(), "a password");
  if (!password.ok()) return Failure{key + password.failure()};
  while (password->ends_with('\n') || password->ends_with('\r')) password->pop_back();
  const bool is_line =
      std::none_of(password->begin(), password->end(), [](char c) { return c == '\n' || c == '\0'; });
  if (is_line && !password->empty() && password->size() <= kMaxCharacters) return password;
  return Failure{key + config.password_file->string() + ": expected one line of 1 to 256 characters, found " +
                 (is_line ? std::to_string(password->size()) : "several")};
}

}  // namespace traygauge
