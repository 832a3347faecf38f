// A request and its answer, as handlers see them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "firmware/web/byte_stream.hpp"
#include "firmware/web/peer_address.hpp"
#include "firmware/web/request_target.hpp"
#include "firmware/web/role.hpp"

namespace traygauge {

struct HttpRequest {
  std::string method;                 // as sent; see also is_head()
  std::vector<std::string> segments;  // of the path, decoded, without the base path
  bool is_folder = false;             // the path ended in '/'
  NamedTexts query;                   // decoded
  NamedTexts path_parameters;         // what stood at {name} in the route's pattern
  NamedTexts headers;                 // those of kept_headers(), names in lower case
  std::string body;                   // empty while only the head is known
  std::size_t max_body_bytes = 0;     // what the body may have
  PeerAddress peer;                   // who holds the connection
  std::string client;                 // who asks: the peer, or whom a trusted proxy names
  Role role = Role::none;             // granted
  std::string token_name;             // the name that stands beside the token, for messages

  bool is_head() const { return method == "HEAD"; }
  std::string path() const { return path_text(segments); }
  // The first of that name, or null.
  const std::string* header(std::string_view name) const { return find_text(headers, name); }
  const std::string* parameter(std::string_view name) const { return find_text(query, name); }
  const std::string* path_parameter(std::string_view name) const { return find_text(path_parameters, name); }
};

// Of all others nothing is known to handlers.
bool is_kept_header(std::string_view lower_case_name);

struct HttpResponse {
  // Shared: a page's file, of which no request makes a copy.
  using Body = std::variant<std::string, std::shared_ptr<const std::string>, std::unique_ptr<ByteStream>>;

  int status = 200;
  std::string content_type = "application/json";
  NamedTexts headers;
  Body body;
};

HttpResponse json_response(std::string json, int status = 200);
// {"error":{"code","message"}}: the code for programs, the message a sentence for people.
HttpResponse error_response(int status, std::string_view code, std::string_view message);

}  // namespace traygauge
