#include "firmware/web/tokens.hpp"

#include <algorithm>
#include <utility>

#include "firmware/base/secret_file.hpp"

namespace traygauge {
namespace {

bool is_token_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("-._~+/=").find(c) != std::string_view::npos;
}

bool may_be_token(std::string_view text) {
  return text.size() >= TokenList::kMinCharacters && text.size() <= TokenList::kMaxCharacters &&
         std::all_of(text.begin(), text.end(), is_token_character);
}

std::string_view without_spaces(std::string_view text) {
  constexpr std::string_view kSpaces = " \t\r";
  const std::size_t first = text.find_first_not_of(kSpaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

}  // namespace

TokenList::Padded TokenList::padded(std::string_view token) {
  Padded text{};
  std::copy(token.begin(), token.end(), text.begin());
  return text;
}

// volatile keeps the compiler from ending the loop at the first difference.
bool TokenList::are_equal(const Padded& a, const Padded& b) {
  volatile unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
  return difference == 0;
}

std::optional<TokenHolder> TokenList::find(std::string_view token) const {
  if (!may_be_token(token)) return std::nullopt;
  const Padded wanted = padded(token);
  const Token* found = nullptr;
  for (const Token& known : tokens_) {
    if (are_equal(wanted, known.text)) found = &known;
  }
  if (found == nullptr) return std::nullopt;
  return found->holder;
}

Expected<void> TokenList::add(std::string_view line, Role role, const std::string& place) {
  const std::size_t space = line.find_first_of(" \t");
  const std::string_view token = line.substr(0, space);
  if (!may_be_token(token))
    return Failure{place + ": expected a token of " + std::to_string(kMinCharacters) + " to " +
                   std::to_string(kMaxCharacters) +
                   " of A-Z a-z 0-9 - . _ ~ + / =, then its holder's name; make one with: head -c 24 "
                   "/dev/urandom | base64"};
  if (find(token)) return Failure{place + ": this token stands in a line before, too; make another one"};
  const std::string_view name = space == std::string_view::npos ? "" : without_spaces(line.substr(space));
  if (!is_utf8(name)) return Failure{place + ": expected a name in UTF-8"};
  tokens_.push_back({padded(token), {role, std::string(name)}});
  return {};
}

Expected<void> TokenList::read(const TokenFile& file) {
  const Expected<std::string> text = read_secret_file(file.path.string(), "tokens");
  if (!text.ok()) return Failure{text.failure()};
  std::string_view rest = *text;
  const std::size_t before = tokens_.size();
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = without_spaces(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty() || line.front() == '#') continue;
    Expected<void> added = add(line, file.role, file.path.string() + ":" + std::to_string(number));
    if (added.ok()) continue;
    tokens_.resize(before);
    return added;
  }
  return {};
}

Expected<void> Tokens::read() {
  TokenList list;
  problem_.clear();
  for (const TokenFile& file : files_) {
    const Expected<void> read = list.read(file);
    if (!read.ok() && problem_.empty()) problem_ = read.failure();
  }
  list_ = std::move(list);
  if (!problem_.empty()) return Failure{problem_};
  return {};
}

void Tokens::refresh(SteadyTime now) {
  constexpr std::chrono::seconds kEvery{1};
  if (files_.empty() || now - read_at_ < kEvery) return;
  read_at_ = now;
  const TokenList before = list_;
  static_cast<void>(read());  // problem() tells
  if (!(list_ == before)) ++changes_;
}

}  // namespace traygauge
