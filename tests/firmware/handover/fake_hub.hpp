// A hub that answers as a test tells it to, in a thread of its own.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "firmware/handover/local_socket.hpp"
#include "firmware/handover/message.hpp"

namespace traygauge::test {

class FakeHub {
 public:
  // What it sends after a message; nothing: it stays silent. "hang up" as the first text closes the
  // connection.
  using Answer = std::function<std::vector<Message>(const Message&)>;

  FakeHub(const std::filesystem::path& socket, Answer answer);
  ~FakeHub();
  FakeHub(const FakeHub&) = delete;
  FakeHub& operator=(const FakeHub&) = delete;

  std::vector<Message> received() const;
  // The messages of one type.
  std::vector<Message> received(MessageType type) const;

 private:
  void run();

  LocalListener listener_;
  Answer answer_;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  std::vector<Message> received_;
  std::thread thread_;
};

// "stored" for every scan's id, as a hub that works does.
std::vector<Message> store_all(const Message& message);
inline constexpr const char* kHangUp = "hang up";

}  // namespace traygauge::test
