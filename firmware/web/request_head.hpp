// The header fields of a request, looked at before a handler sees them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/web/http_message.hpp"

namespace traygauge {

struct HeadFields {
  NamedTexts kept;  // see is_kept_header()
  unsigned hosts = 0;
  unsigned lengths = 0;
  unsigned encodings = 0;
  bool is_chunked = false;
  bool expects = false;  // the client waits for a word before it sends the body
  std::uint64_t content_length = 0;
};

void take_field(HeadFields& fields, std::string_view name, std::string_view value);

// Two ways to say how long the body is, or two hosts: a proxy may read such a request differently.
std::optional<HttpResponse> refuse_ambiguous(const HeadFields& fields);
HttpResponse refuse_large_body(std::size_t max_bytes);

// A body to send, and how long it is where that is known.
struct SizedStream {
  std::unique_ptr<ByteStream> stream;
  std::optional<std::uint64_t> bytes;
};
SizedStream stream_of(HttpResponse::Body body);

}  // namespace traygauge
