// The hub's web site: checks each request, finds who answers it, and protects the answer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/web/access.hpp"
#include "firmware/web/event_streams.hpp"
#include "firmware/web/request_handler.hpp"
#include "firmware/web/request_origin.hpp"
#include "firmware/web/router.hpp"
#include "firmware/web/static_files.hpp"

namespace traygauge {

struct SiteParams {
  // Names of the hub beside localhost and literal addresses: see OwnHosts.
  std::vector<std::string> host_names;
  // Where a proxy passes addresses on as they are: taken off their beginning; see parse_base_path().
  std::vector<std::string> base_path;
};

// What the parts are made of outlives the site.
class Site final : public RequestHandler {
 public:
  Site(SiteParams params, Access& access, const Router& router, const StaticFiles& files,
       EventStreams& events);

  std::optional<HttpResponse> admit(HttpRequest& request) override;
  HttpResponse answer(HttpRequest& request) override;
  // Reads tokens again; pages whose tokens may have been revoked connect anew.
  void attend(SteadyTime now) override;

 private:
  std::optional<HttpResponse> refuse(HttpRequest& request);
  void take_base_path_off(HttpRequest& request) const;

  OwnHosts hosts_;
  std::vector<std::string> base_;
  Access& access_;
  const Router& router_;
  const StaticFiles& files_;
  EventStreams& events_;
  std::uint64_t token_changes_ = 0;
};

}  // namespace traygauge
