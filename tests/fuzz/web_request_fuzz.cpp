// A request, as a client may write it: first line, header fields, an empty line, the body. Leads through
// everything between libmicrohttpd and the handlers.
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>

#include "firmware/web/login.hpp"
#include "firmware/web/request_intake.hpp"
#include "firmware/web/site.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

constexpr std::string_view kToken = "view-token-0123456789";

class FuzzedSite {
 public:
  FuzzedSite() {
    demand(access_.check_listen({}).ok(), "tokens are read");
    demand(files_.add("index.html", "page").ok(), "a page");
    const auto tell = [](const HttpRequest&) { return json_response("{}"); };
    router_.add({"GET", "/api/v1/scans/{id}", Role::view, 0, tell});
    router_.add({"PUT", "/api/v1/scans/{id}/items/{item}", Role::view, 500, tell});
    router_.add({"POST", "/open", Role::none, 2000, tell});
    router_.add({"GET", "/api/v1/events", Role::view, 0,
                 [this](const HttpRequest& request) { return events_.open(request); }});
    add_login_routes(router_, access_);
  }

  void ask(const RequestHead& head, const PeerAddress& peer, std::string_view body) {
    const auto target = parse_target(head.target);
    if (target.ok()) check(*target);
    RequestIntake intake(limits_, site_);
    const RequestIntake::Next next = intake.begin(head, peer);
    for (bool goes_on = next == RequestIntake::Next::body; goes_on && !body.empty();) {
      const std::size_t piece = std::min<std::size_t>(body.size(), 100);
      goes_on = intake.take_body(body.substr(0, piece));
      body.remove_prefix(piece);
    }
    const HttpResponse response = intake.answer();
    demand(response.status >= 200 && response.status < 600 && response.status != 500,
           "a status of an answer");
    const auto* const text = std::get_if<std::string>(&response.body);
    if (text != nullptr) demand(text->find(kToken) == std::string::npos, "no answer holds the token");
    if (text != nullptr && response.status >= 400)
      demand(text->starts_with("{\"error\":{\"code\":"), "an error");
  }

 private:
  static void check(const RequestTarget& target) {
    for (const std::string& segment : target.segments) {
      demand(!segment.empty() && segment != "." && segment != ".." && is_utf8(segment), "a segment");
      demand(segment.find_first_of(std::string_view("/\\\0\r\n", 5)) == std::string::npos, "no separator");
    }
    for (const auto& [name, value] : target.query)
      demand(is_utf8(name) && is_utf8(value), "a query in UTF-8");
  }

  TokenFile write_tokens() const {
    const auto path = folder_.path() / "view";
    std::ofstream(path) << kToken << " fuzz\n";
    ::chmod(path.c_str(), S_IRUSR | S_IWUSR);
    return {path, Role::view};
  }

  TemporaryFolder folder_;
  HttpLimits limits_;
  Access access_{{{write_tokens()}, LocalRule::open, {*AddressRange::parse("10.0.0.0/8")}, {}}};
  Router router_;
  StaticFiles files_;
  EventStreams events_{EventStreamLimits{}};
  Site site_{{{"hub.local"}, {"kitchen"}}, access_, router_, files_, events_};
};

PeerAddress peer_of(std::size_t choice) {
  constexpr std::array<const char*, 3> kPeers{"192.0.2.1", "10.1.2.3", "2001:db8::1"};
  return choice % 4 == 3 ? PeerAddress() : *PeerAddress::parse(kPeers[choice % 4]);
}

}  // namespace
}  // namespace traygauge

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static traygauge::FuzzedSite site;
  std::string_view rest = traygauge::text_of_input(data, size);
  std::string_view first = traygauge::take_until(rest, '\n');
  traygauge::RequestHead head;
  head.header_bytes = size;
  head.method = first.substr(0, first.find(' '));
  head.target = first.substr(std::min(head.method.size() + 1, first.size()));
  while (!rest.empty()) {
    const std::string_view line = traygauge::take_until(rest, '\n');
    if (line.empty()) break;
    const std::size_t colon = std::min(line.find(": "), line.size());
    traygauge::take_field(head.fields, line.substr(0, colon), line.substr(std::min(colon + 2, line.size())));
  }
  site.ask(head, traygauge::peer_of(size), rest);
  return 0;
}
