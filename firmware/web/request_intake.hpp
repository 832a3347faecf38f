// One request as it comes in, and what it is answered.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "firmware/web/connection_limits.hpp"
#include "firmware/web/http_message.hpp"
#include "firmware/web/request_handler.hpp"
#include "firmware/web/request_head.hpp"

namespace traygauge {

// What the first lines of a request say.
struct RequestHead {
  std::string_view method;
  std::string_view target;  // as sent
  HeadFields fields;
  std::size_t header_bytes = 0;
};

class RequestIntake {
 public:
  // What is to be done after the head.
  enum class Next : std::uint8_t {
    body,    // take_body() until it is over, then answer(): what was refused is answered then, too
    refuse,  // answer() at once and close: the body is long, or the client waits before it sends it
  };

  RequestIntake(const HttpLimits& limits, RequestHandler& handler) : limits_(limits), handler_(handler) {}

  Next begin(RequestHead head, const PeerAddress& peer);
  // False where the connection is to be closed: far more comes than was allowed.
  bool take_body(std::string_view data);
  HttpResponse answer();
  bool is_refused() const { return refusal_.has_value(); }

 private:
  std::optional<HttpResponse> refuse_head(const RequestHead& head);

  const HttpLimits& limits_;
  RequestHandler& handler_;
  HttpRequest request_;
  std::optional<HttpResponse> refusal_;
  std::size_t discarded_bytes_ = 0;
};

}  // namespace traygauge
