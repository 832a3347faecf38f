// Answers with what it was asked.
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>

#include "firmware/web/request_handler.hpp"

namespace traygauge::test {

// GET /length/N: N bytes, their count told; /pieces/N: N pieces of 1000 bytes; /throw; else: path and query,
// and the body. Bodies may have `max_body_bytes`; /refused is refused by its head.
class EchoHandler final : public RequestHandler {
 public:
  explicit EchoHandler(std::size_t max_body_bytes = 1000) : max_body_bytes_(max_body_bytes) {}

  std::optional<HttpResponse> admit(HttpRequest& request) override {
    request.max_body_bytes = max_body_bytes_;
    if (request.path() == "/refused") return error_response(403, "refused", "No.");
    return std::nullopt;
  }

  HttpResponse answer(HttpRequest& request) override {
    ++answered;
    HttpResponse response;
    response.content_type = "text/plain";
    const std::string first = request.segments.empty() ? "" : request.segments.front();
    const std::string second = request.segments.size() > 1 ? request.segments[1] : "0";
    if (first == "throw") throw std::runtime_error("the handler failed");
    if (first == "split") response.headers.emplace_back("X-Name", "a\r\nSet-Cookie: b");
    if (first == "length") {
      response.body = std::string(std::stoul(second), 'x');
    } else if (first == "pieces") {
      response.body = make_piece_stream([left = std::stoi(second)]() mutable -> Expected<std::string> {
        if (left < 0) return Failure{"broken"};
        return left-- > 0 ? std::string(1000, 'y') : std::string();
      });
    } else {
      std::string text = request.method + " " + request.path();
      for (const auto& [name, value] : request.query) text += " " + name + "=" + value;
      response.body = text + " [" + request.body + "]";
    }
    return response;
  }

  void attend(SteadyTime) override { ++attended; }

  std::atomic<int> answered = 0;
  std::atomic<int> attended = 0;

 private:
  std::size_t max_body_bytes_;
};

}  // namespace traygauge::test
