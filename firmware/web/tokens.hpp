// Tokens: secrets that grant a role, each file one role.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/web/request_handler.hpp"
#include "firmware/web/role.hpp"

namespace traygauge {

// One token a line and, after a space, the name of its holder; lines that begin with '#' are for people. The
// file belongs to this user or root, and nobody else may read it.
struct TokenFile {
  std::filesystem::path path;
  Role role = Role::view;
};

struct TokenHolder {
  Role role = Role::none;
  std::string name;  // may be empty

  friend bool operator==(const TokenHolder&, const TokenHolder&) = default;
};

class TokenList {
 public:
  static constexpr std::size_t kMinCharacters = 20;
  static constexpr std::size_t kMaxCharacters = 128;

  // Appends what the file holds. The failure names the line, never what stands there.
  Expected<void> read(const TokenFile& file);
  // Takes as long for every text that may be a token: all are compared, each as a whole.
  std::optional<TokenHolder> find(std::string_view token) const;
  std::size_t size() const { return tokens_.size(); }

  friend bool operator==(const TokenList&, const TokenList&) = default;

 private:
  // Padded with zeros, which no token holds: so two are equal only where their lengths are.
  using Padded = std::array<unsigned char, kMaxCharacters>;
  struct Token {
    Padded text{};
    TokenHolder holder;
    friend bool operator==(const Token&, const Token&) = default;
  };
  static Padded padded(std::string_view token);
  static bool are_equal(const Padded& a, const Padded& b);
  Expected<void> add(std::string_view line, Role role, const std::string& place);

  std::vector<Token> tokens_;
};

// The tokens of all files, read again once a second, so that a line that is deleted grants nothing any more.
class Tokens {
 public:
  explicit Tokens(std::vector<TokenFile> files) : files_(std::move(files)) {}

  // Files are named: tokens are demanded, even where the files hold none.
  bool are_configured() const { return !files_.empty(); }
  // Reads all files. A file that cannot be read grants nothing; the failure tells the first.
  Expected<void> read();
  // Reads again where a second has passed.
  void refresh(SteadyTime now);
  // How often tokens changed since the start.
  std::uint64_t changes() const { return changes_; }
  // Why a file grants nothing now; empty: all are well.
  const std::string& problem() const { return problem_; }
  std::optional<TokenHolder> find(std::string_view token) const { return list_.find(token); }

 private:
  std::vector<TokenFile> files_;
  TokenList list_;
  std::string problem_;
  std::uint64_t changes_ = 0;
  SteadyTime read_at_;
};

}  // namespace traygauge
