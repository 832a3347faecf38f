#include "tests/firmware/handover/fake_hub.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace traygauge::test {
namespace {

LocalListener listen(const std::filesystem::path& socket) {
  auto listener = LocalListener::open(socket);
  if (!listener.ok()) throw std::runtime_error(listener.failure());
  return std::move(*listener);
}

}  // namespace

FakeHub::FakeHub(const std::filesystem::path& socket, Answer answer)
    : listener_(listen(socket)), answer_(std::move(answer)), thread_([this] { run(); }) {}

FakeHub::~FakeHub() {
  stop_ = true;
  thread_.join();
}

std::vector<Message> FakeHub::received() const {
  const std::lock_guard lock(mutex_);
  return received_;
}

std::vector<Message> FakeHub::received(MessageType type) const {
  std::vector<Message> all = received();
  std::erase_if(all, [type](const Message& message) { return message.type != type; });
  return all;
}

void FakeHub::run() {
  LocalConnection connection;
  MessageReader reader;
  while (!stop_) {
    if (!connection.is_open()) {
      auto accepted = listener_.accept();
      if (accepted.ok() && accepted->is_open()) {
        connection = std::move(*accepted);
        reader = MessageReader();
      } else {
        std::this_thread::sleep_for(Milliseconds(1));
        continue;
      }
    }
    const auto bytes = connection.receive_some(Milliseconds(5));
    if (!bytes.ok()) {
      connection.close();
      continue;
    }
    reader.append(*bytes);
    for (auto next = reader.next(); next.ok() && *next; next = reader.next()) {
      {
        const std::lock_guard lock(mutex_);
        received_.push_back(**next);
      }
      for (const Message& reply : answer_(**next)) {
        if (reply.text == kHangUp) {
          connection.close();
        } else if (connection.is_open()) {
          static_cast<void>(connection.send_all(encode(reply), Milliseconds(1000)));
        }
      }
      if (!connection.is_open()) break;
    }
  }
}

std::vector<Message> store_all(const Message& message) {
  if (message.type != MessageType::scan) return {};
  const auto json = nlohmann::json::parse(message.text);
  return {{MessageType::stored, nlohmann::json{{"id", json.at("id")}}.dump(), {}}};
}

}  // namespace traygauge::test
