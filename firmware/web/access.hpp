// Who may do what: tokens, proxies, and what needs no token.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/web/attempt_limiter.hpp"
#include "firmware/web/http_message.hpp"
#include "firmware/web/listener.hpp"
#include "firmware/web/tokens.hpp"

namespace traygauge {

// Whether who is on this machine needs a token.
enum class LocalRule : std::uint8_t {
  open_without_tokens,  // no, as long as no token file is named
  open,                 // no: for a screen on this machine, with no proxy beside it
  tokens,               // yes: a proxy on this machine lets others in
};

struct AccessParams {
  std::vector<TokenFile> token_files;
  LocalRule local = LocalRule::open_without_tokens;
  // Whose X-Forwarded-For is believed; nobody else's.
  std::vector<AddressRange> trusted_proxies;
  AttemptLimits attempts;
};

// Who asks, as far as it can be known.
struct Client {
  PeerAddress address;
  bool is_forwarded = false;  // a proxy stands between, or somebody says so
};

class Access {
 public:
  explicit Access(AccessParams params);

  // Before anything listens: refuses addresses that others reach where no token is demanded.
  Expected<void> check_listen(const std::vector<ListenAddress>& addresses);

  // Sets client, role and token_name of the request; an answer (401, 403, 429) refuses it. Where `minimum` is
  // none, tokens are not looked at.
  std::optional<HttpResponse> admit(HttpRequest& request, Role minimum, SteadyTime now);
  // Whose token that is; counts as an attempt of the request's client where it is nobody's. The answer
  // refuses.
  struct Login {
    TokenHolder holder;
    std::optional<HttpResponse> refusal;
  };
  Login log_in(const HttpRequest& request, std::string_view token, SteadyTime now);

  // Reads token files again, at most once a second.
  void refresh(SteadyTime now) { tokens_.refresh(now); }
  // How often tokens changed since the start: who came by one that is revoked has to come again.
  std::uint64_t token_changes() const { return tokens_.changes(); }
  // Why a token file grants nothing, for /health and the log; empty: all are well.
  const std::string& problem() const { return tokens_.problem(); }
  Client client_of(const HttpRequest& request) const;

 private:
  bool is_open_to(const Client& client) const;

  AccessParams params_;
  Tokens tokens_;
  AttemptLimiter attempts_;
};

// The token of an Authorization header or, without one, of the cookie; never of the address.
std::optional<std::string_view> token_of(const HttpRequest& request);

inline constexpr std::string_view kTokenCookie = "traygauge_token";
std::optional<std::string_view> cookie_token_of(const HttpRequest& request);

}  // namespace traygauge
