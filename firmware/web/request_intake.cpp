#include "firmware/web/request_intake.hpp"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

namespace traygauge {
namespace {

// What is read of a refused body and thrown away, so that the client gets to see the refusal.
constexpr std::size_t kMaxDiscardedBytes = 64UL * 1024;

}  // namespace

RequestIntake::Next RequestIntake::begin(RequestHead head, const PeerAddress& peer) {
  request_.method = head.method;
  request_.peer = peer;
  request_.client = peer.text();
  request_.headers = std::move(head.fields.kept);
  refusal_ = refuse_head(head);
  if (!refusal_) return Next::body;
  // Short bodies are read to their end, so that the connection can be used again.
  const bool is_short = head.fields.encodings == 0 && head.fields.lengths < 2 &&
                        head.fields.content_length <= kMaxDiscardedBytes;
  return is_short && !head.fields.expects ? Next::body : Next::refuse;
}

std::optional<HttpResponse> RequestIntake::refuse_head(const RequestHead& head) {
  if (head.header_bytes > limits_.max_header_bytes)
    return error_response(431, "header_too_large",
                          "The head of the request has more than the " +
                              std::to_string(limits_.max_header_bytes) + " bytes that are taken.");
  if (auto refusal = refuse_ambiguous(head.fields)) return refusal;
  Expected<RequestTarget> target = parse_target(head.target);
  if (!target.ok())
    return error_response(400, "bad_address", "The address is not valid: " + target.failure() + ".");
  request_.segments = std::move(target->segments);
  request_.is_folder = target->is_folder;
  request_.query = std::move(target->query);
  if (auto refusal = handler_.admit(request_)) return refusal;
  request_.max_body_bytes = std::min(request_.max_body_bytes, limits_.max_body_bytes);
  if (head.fields.content_length > request_.max_body_bytes) return refuse_large_body(request_.max_body_bytes);
  return std::nullopt;
}

bool RequestIntake::take_body(std::string_view data) {
  if (!refusal_ && request_.body.size() + data.size() > request_.max_body_bytes) {
    request_.body.clear();
    refusal_ = refuse_large_body(request_.max_body_bytes);
  }
  if (!refusal_) {
    request_.body += data;
    return true;
  }
  discarded_bytes_ += data.size();
  return discarded_bytes_ <= kMaxDiscardedBytes;
}

HttpResponse RequestIntake::answer() {
  if (refusal_) return std::move(*refusal_);
  try {
    return handler_.answer(request_);
  } catch (const std::exception&) {
    return error_response(500, "internal_error", "The hub could not answer this request.");
  }
}

}  // namespace traygauge
