#include "firmware/web/request_head.hpp"

#include <strings.h>

#include <algorithm>
#include <charconv>
#include <span>
#include <utility>
#include <variant>

namespace traygauge {
namespace {

class TextStream final : public ByteStream {
 public:
  explicit TextStream(std::shared_ptr<const std::string> text) : text_(std::move(text)) {}

  Piece read(std::span<char> into) override {
    const std::size_t bytes = std::min(into.size(), text_->size() - at_);
    std::copy_n(text_->data() + at_, bytes, into.data());
    at_ += bytes;
    return {bytes == 0 ? State::end : State::data, bytes};
  }

 private:
  std::shared_ptr<const std::string> text_;
  std::size_t at_ = 0;
};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; });
  return lower;
}

}  // namespace

void take_field(HeadFields& fields, std::string_view name, std::string_view value) {
  std::string lower = lower_case(name);
  if (lower == "host") ++fields.hosts;
  if (lower == "expect") fields.expects = true;
  if (lower == "content-length") {
    ++fields.lengths;
    std::from_chars(value.data(), value.data() + value.size(), fields.content_length);
  }
  if (lower == "transfer-encoding") {
    ++fields.encodings;
    fields.is_chunked = lower_case(value) == "chunked";
  }
  if (is_kept_header(lower)) fields.kept.emplace_back(std::move(lower), value);
}

std::optional<HttpResponse> refuse_ambiguous(const HeadFields& fields) {
  if (fields.hosts > 1 || fields.lengths > 1 || (fields.lengths > 0 && fields.encodings > 0))
    return error_response(400, "ambiguous_request", "The request names two hosts or two lengths.");
  if (fields.encodings > 1 || (fields.encodings == 1 && !fields.is_chunked))
    return error_response(501, "unknown_encoding", "The only Transfer-Encoding that is known is chunked.");
  return std::nullopt;
}

HttpResponse refuse_large_body(std::size_t max_bytes) {
  return error_response(
      413, "body_too_large",
      "The body has more than the " + std::to_string(max_bytes) + " bytes that are taken here.");
}

SizedStream stream_of(HttpResponse::Body body) {
  if (auto* const stream = std::get_if<std::unique_ptr<ByteStream>>(&body))
    return {std::move(*stream), std::nullopt};
  std::shared_ptr<const std::string> text;
  if (auto* const own = std::get_if<std::string>(&body)) {
    text = std::make_shared<const std::string>(std::move(*own));
  } else {
    text = std::get<std::shared_ptr<const std::string>>(std::move(body));
  }
  const std::uint64_t bytes = text->size();
  return {std::make_unique<TextStream>(std::move(text)), bytes};
}

}  // namespace traygauge
