#include "firmware/handover/hub_link.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "firmware/base/json_reading.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

// An object, or an empty one where the text is none: a peer's mistake then reads as absent keys.
Json object_of(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  return json.is_object() ? json : Json::object();
}

std::optional<HubAnswer> answer_of(MessageType type) {
  switch (type) {
    case MessageType::stored:
      return HubAnswer::stored;
    case MessageType::set_aside:
      return HubAnswer::set_aside;
    case MessageType::refused:
      return HubAnswer::refused;
    default:
      return std::nullopt;
  }
}

}  // namespace

HubReply HubLink::deliver(std::string_view id, const std::string& document) {
  if (const Expected<void> connected = connect(); !connected.ok())
    return {HubAnswer::absent, connected.failure()};
  const auto end = SteadyClock::now() + params_.answer_timeout;
  const Expected<void> sent = connection_.send_all(
      encode({MessageType::scan, Json{{"id", id}}.dump(), document}), params_.answer_timeout);
  if (!sent.ok()) {
    disconnect();
    return {HubAnswer::absent, sent.failure()};
  }
  for (;;) {
    const auto left = std::chrono::ceil<Milliseconds>(end - SteadyClock::now());
    if (left <= Milliseconds::zero()) {
      // What it says later may be about this document, and a new connection asks again.
      disconnect();
      return {HubAnswer::absent,
              "the hub did not answer within " + std::to_string(params_.answer_timeout.count()) + " ms"};
    }
    const Expected<std::optional<HubReply>> reply = read_reply(id, left);
    if (!reply.ok()) {
      disconnect();
      return {HubAnswer::absent, reply.failure()};
    }
    if (*reply) return **reply;
  }
}

void HubLink::tell(const Message& message, Milliseconds longest_wait) {
  if (!connect().ok()) return;
  // Half a message is of no use, and a hub that reads takes it in a few milliseconds: this one hangs.
  if (!connection_.send_all(encode(message), longest_wait).ok()) disconnect();
}

void HubLink::attend() {
  if (!connect().ok()) return;
  if (!read_reply({}, Milliseconds::zero()).ok()) disconnect();
}

Expected<void> HubLink::connect() {
  if (connection_.is_open()) return {};
  const auto now = SteadyClock::now();
  if (was_tried_ && now - tried_at_ < params_.retry_after) return Failure{last_failure_};
  was_tried_ = true;
  tried_at_ = now;
  Expected<LocalConnection> connected = connect_local(params_.socket);
  if (!connected.ok()) {
    last_failure_ = connected.failure();
    return Failure{last_failure_};
  }
  connection_ = std::move(*connected);
  reader_ = MessageReader();
  const Json hello = {{"station", params_.station}, {"program", params_.program_version}};
  const Expected<void> sent =
      connection_.send_all(encode({MessageType::hello, hello.dump(), {}}), params_.answer_timeout);
  if (!sent.ok()) {
    last_failure_ = sent.failure();
    disconnect();
    return Failure{last_failure_};
  }
  is_new_ = true;
  return {};
}

void HubLink::disconnect() {
  connection_.close();
  reader_ = MessageReader();
}

// The first answer about `id`; answers about others are passed over. None when `timeout` passes.
Expected<std::optional<HubReply>> HubLink::read_reply(std::string_view id, Milliseconds timeout) {
  const Expected<std::string> received = connection_.receive_some(timeout);
  if (!received.ok()) return Failure{received.failure()};
  reader_.append(*received);
  for (;;) {
    Expected<std::optional<Message>> next = reader_.next();
    if (!next.ok()) return Failure{next.failure()};
    if (!*next) return std::optional<HubReply>();
    const Message& message = **next;
    if (message.type == MessageType::next_tray) next_tray_ = message.text;
    const auto answer = answer_of(message.type);
    if (!answer) continue;
    const Json json = object_of(message.text);
    if (!id.empty() && json_text(json, "id") == id)
      return std::optional(HubReply{*answer, json_text(json, "why")});
  }
}

}  // namespace traygauge
