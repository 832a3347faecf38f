// Which handler answers what, and who may ask for it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/web/http_message.hpp"

namespace traygauge {

using RequestFunction = std::function<HttpResponse(const HttpRequest& request)>;

struct Route {
  std::string method;  // "GET" answers HEAD, too
  // "/api/v1/scans/{id}/mesh": a part in braces stands for one segment, HttpRequest::path_parameter() gives
  // it.
  std::string pattern;
  Role minimum = Role::manage;
  std::size_t max_body_bytes = 0;
  RequestFunction answer;
};

struct FoundRoute {
  const Route* route = nullptr;      // none answers this method
  NamedTexts parameters;             // of the pattern
  std::vector<std::string> methods;  // that are answered at this path; none: there is nothing
};

class Router {
 public:
  // Where several patterns fit a path, the first one added counts.
  void add(Route route);
  // All, in the order they were added.
  std::vector<const Route*> routes() const;
  FoundRoute find(std::string_view method, const std::vector<std::string>& segments) const;

 private:
  struct Entry {
    Route route;
    std::vector<std::string> segments;
  };
  std::vector<Entry> entries_;
};

}  // namespace traygauge
