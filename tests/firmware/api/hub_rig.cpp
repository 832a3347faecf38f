#include "tests/firmware/api/hub_rig.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

FileDescriptor connect_to(std::uint16_t port) {
  FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  // A hub that hangs fails the test and does not stop it.
  const timeval longest{20, 0};
  ::setsockopt(socket.number(), SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof(longest));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    throw std::runtime_error("the hub does not listen");
  return socket;
}

void send_all(const FileDescriptor& socket, const std::string& request) {
  if (::send(socket.number(), request.data(), request.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(request.size()))
    throw std::runtime_error("the hub does not read");
}

// What a server sends until it closes, or has sent `until`.
std::string receive(const FileDescriptor& socket, const std::string& until = {}) {
  std::string text;
  char buffer[65536];
  for (ssize_t count = 1; count > 0;) {
    count = ::recv(socket.number(), buffer, sizeof(buffer), 0);
    if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
    if (!until.empty() && text.find(until) != std::string::npos) break;
  }
  return text;
}

std::string head_text(const std::string& method, const std::string& target, const std::string& headers) {
  std::string text = method;
  text += " " + target + " HTTP/1.1\r\nConnection: close\r\n";
  if (headers.find("Host: ") == std::string::npos) text += "Host: localhost\r\n";
  return text + headers;
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

HubRig::HubRig(WebConfig web, std::filesystem::path station_file)
    : web_(std::move(web)), station_file_(std::move(station_file)) {
  web_.listen = {"127.0.0.1:0"};
  start_hub();
}

void HubRig::start_hub() {
  HubParams params;
  params.socket = folder_.path() / "hub";
  params.store.options.file = folder_.path() / "results.db";
  params.web.config = web_;
  params.web.station_file = station_file_;
  auto hub = Hub::start(params, [](const std::string&) {});
  if (!hub.ok()) throw std::runtime_error(hub.failure());
  hub_ = std::move(*hub);
  const std::string addresses = hub_->web()->addresses();
  port_ = static_cast<std::uint16_t>(std::stoi(addresses.substr(addresses.rfind(':') + 1)));
  start_loop();
  HubLinkParams link;
  link.socket = params.socket;
  link.station = "kitchen";
  link.program_version = "1.2.3";
  station_ = std::make_unique<HubLink>(link);
}

void HubRig::restart() {
  stop_loop();
  station_.reset();
  hub_.reset();
  start_hub();
}

HubRig::~HubRig() {
  stop_loop();
}

void HubRig::start_loop() {
  stop_ = false;
  thread_ = std::thread([this] {
    while (!stop_) hub_->step(Milliseconds(20));
  });
}

void HubRig::stop_loop() {
  stop_ = true;
  thread_.join();
}

Answer HubRig::checked(Exchange exchange) const {
  const ApiDescription& description = ApiDescription::own();
  for (const std::string& objection : description.objections(exchange)) ADD_FAILURE() << objection;
  answers_.insert(description.answer_name(exchange));
  return std::move(exchange.answer);
}

Answer HubRig::request(const std::string& method, const std::string& target, const std::string& headers,
                       const std::string& body) const {
  const FileDescriptor socket = connect_to(port_);
  std::string text = head_text(method, target, headers);
  if (!body.empty() || method == "POST") text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
  send_all(socket, text + "\r\n" + body);
  return checked({method, target, body, parsed(receive(socket))});
}

Answer HubRig::get(const std::string& target, const std::string& headers) const {
  return request("GET", target, headers, {});
}

Answer HubRig::post(const std::string& target, const std::string& body, const std::string& headers) const {
  return request("POST", target, headers, body);
}

Listening HubRig::listen(const std::string& until, const std::string& headers) const {
  const std::string target = "/api/v1/events";
  FileDescriptor socket = connect_to(port_);
  send_all(socket, head_text("GET", target, headers) + "\r\n");
  Answer answer = checked({"GET", target, {}, parsed(receive(socket, until))});
  return {std::move(socket), std::move(answer)};
}

std::string HubRig::hear(const Listening& listening, const std::string& until) {
  return receive(listening.socket, until);
}

void HubRig::lose_station() {
  stop_loop();
  station_.reset();
  const auto is_connected = [this] { return hub_->inbox().stations().at("kitchen").is_connected; };
  for (int i = 0; i < 100 && is_connected(); ++i) hub_->step(Milliseconds(10));
  if (is_connected()) throw std::runtime_error("the hub takes the station for connected");
  start_loop();
}

void HubRig::lose_store() {
  stop_loop();
  const std::filesystem::path file = folder_.path() / "results.db";
  hub_->store().store()->database().note_damage("for a test");
  std::filesystem::remove(file);
  std::filesystem::create_directories(file / "no database");
  hub_->step(Milliseconds(0));
  if (hub_->store().store() != nullptr) throw std::runtime_error("the hub has a store again");
  start_loop();
}

std::map<std::string, std::string> HubRig::routes() const {
  std::map<std::string, std::string> all;
  for (const Route* const route : hub_->web()->router().routes())
    all.emplace(route->method + " " + route->pattern, role_name(route->minimum));
  return all;
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
  deliver(scan.id, document.dump());
}

void HubRig::store(const SampleScan& scan) {
  deliver(scan.id, sample_document(scan));
}

void HubRig::deliver(const ScanId& id, const std::string& document) {
  const HubReply reply = station_->deliver(scan_id_text(id), document);
  if (reply.answer != HubAnswer::stored) throw std::runtime_error("not stored: " + reply.text);
}

}  // namespace traygauge::test
