#include "tests/firmware/api/hub_rig.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "tests/firmware/store/sample_scan.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

// What a server sends until it closes.
std::string converse(std::uint16_t port, const std::string& request) {
  const FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    throw std::runtime_error("the hub does not listen");
  if (::send(socket.number(), request.data(), request.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(request.size()))
    throw std::runtime_error("the hub does not read");
  std::string answer;
  char buffer[65536];
  for (ssize_t count = 1; count > 0;) {
    count = ::recv(socket.number(), buffer, sizeof(buffer), 0);
    if (count > 0) answer.append(buffer, static_cast<std::size_t>(count));
  }
  return answer;
}

std::string dechunked(const std::string& text) {
  std::string body;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find("\r\n", at);
    const std::size_t size = std::strtoul(text.substr(at, end - at).c_str(), nullptr, 16);
    if (size == 0) break;
    body += text.substr(end + 2, size);
    at = end + 2 + size + 2;
  }
  return body;
}

Answer parsed(const std::string& text) {
  const std::size_t end = text.find("\r\n\r\n");
  if (end == std::string::npos) throw std::runtime_error("no answer: " + text);
  Answer answer{std::atoi(text.substr(9, 3).c_str()), text.substr(0, end), text.substr(end + 4)};
  if (answer.head.find("Transfer-Encoding: chunked") != std::string::npos)
    answer.body = dechunked(answer.body);
  return answer;
}

}  // namespace

HubRig::HubRig(WebConfig web) {
  web.listen = {"127.0.0.1:0"};
  HubParams params;
  params.socket = folder_.path() / "hub";
  params.store.options.file = folder_.path() / "results.db";
  params.web = web;
  auto hub = Hub::start(params, [](const std::string&) {});
  if (!hub.ok()) throw std::runtime_error(hub.failure());
  hub_ = std::move(*hub);
  const std::string addresses = hub_->web()->addresses();
  port_ = static_cast<std::uint16_t>(std::stoi(addresses.substr(addresses.rfind(':') + 1)));
  thread_ = std::thread([this] {
    while (!stop_) hub_->step(Milliseconds(20));
  });
  HubLinkParams link;
  link.socket = params.socket;
  link.station = "kitchen";
  link.program_version = "1.2.3";
  station_ = std::make_unique<HubLink>(link);
}

HubRig::~HubRig() {
  stop_ = true;
  thread_.join();
}

Answer HubRig::get(const std::string& target, const std::string& headers) const {
  return parsed(converse(
      port_, "GET " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + headers + "\r\n"));
}

Answer HubRig::post(const std::string& target, const std::string& body, const std::string& headers) const {
  return parsed(converse(port_, "POST " + target +
                                    " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Length: " +
                                    std::to_string(body.size()) + "\r\n" + headers + "\r\n" + body));
}

void HubRig::store(int number, double volume_ml, int seconds, const std::string& status) {
  constexpr std::int64_t kBeginMs = 1795762800000;  // 2026-11-27 07:00:00 UTC
  SampleScan scan;
  scan.id.number = static_cast<std::uint64_t>(number);
  scan.taken_ms = kBeginMs + std::int64_t{1000} * seconds;
  scan.tray = "tray, \"one\"";
  scan.status = status;
  scan.foods = status == "ok" ? std::vector<std::string>{"rice"} : std::vector<std::string>();
  Json document = Json::parse(sample_document(scan));
  for (Json& item : document["items"]) item["volume_ml"] = volume_ml;
  const std::string id = scan_id_text(scan.id);
  const HubReply reply = station_->deliver(id, document.dump());
  if (reply.answer != HubAnswer::stored) throw std::runtime_error("not stored: " + reply.text);
}

}  // namespace traygauge::test
