// Files of tokens for a hub.
#pragma once

#include <string>

#include "firmware/config/hub_tables.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {

// Lives as long as the hub reads them.
class TokenFiles {
 public:
  static constexpr const char* kView = "view-token-0123456789abcdef";
  static constexpr const char* kManage = "manage-token-0123456789abcdef";  // ann's

  TokenFiles();
  WebConfig config() const;
  // The header that carries a token.
  static std::string bearer(const std::string& token);

 private:
  void write(const std::string& name, const std::string& line) const;

  TemporaryFolder folder_;
};

}  // namespace traygauge::test
