// Requests that another site's page makes a browser send.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/web/http_message.hpp"

namespace traygauge {

// The names by which the hub is reached beside `localhost` and literal addresses, such as "hub.local". A page
// of another site can make its own name point to the hub, but not one of these.
class OwnHosts {
 public:
  explicit OwnHosts(std::vector<std::string> names);

  // Of a Host header, with or without a port.
  bool holds(std::string_view host) const;
  // The same, of the names alone: every machine has literal addresses.
  bool has_name(std::string_view host) const;

 private:
  std::vector<std::string> names_;  // lower case
};

// 421 where the Host header names another machine; 403 where a page of another site sent the request.
// Requests that no browser sent have neither Origin nor Sec-Fetch-Site and pass.
std::optional<HttpResponse> refuse_foreign(const HttpRequest& request, const OwnHosts& hosts);

}  // namespace traygauge
