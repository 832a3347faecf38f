// What the server asks about each request.
#pragma once

#include <chrono>
#include <optional>

#include "firmware/web/http_message.hpp"

namespace traygauge {

using SteadyTime = std::chrono::steady_clock::time_point;

class RequestHandler {
 public:
  RequestHandler() = default;
  RequestHandler(const RequestHandler&) = delete;
  RequestHandler& operator=(const RequestHandler&) = delete;
  virtual ~RequestHandler() = default;

  // The head is known, the body not yet. Sets what is granted and max_body_bytes; an answer refuses.
  virtual std::optional<HttpResponse> admit(HttpRequest& request) = 0;
  // The request was admitted and is complete. What it throws becomes a 500.
  virtual HttpResponse answer(HttpRequest& request) = 0;
  // Called about once a second while anybody is connected.
  virtual void attend(SteadyTime now) = 0;
};

}  // namespace traygauge
