// A webhook's receiver in a thread of its own, as well or badly behaved as a test wants it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge::test {

struct ReceivedMessage {
  std::string head;  // with the request's line
  std::string body;
  std::string header(const std::string& name) const;  // empty: it is not there
  std::string event_id() const { return header("Traygauge-Event-Id"); }
};

// What is sent in answer to a message.
struct Reply {
  std::string bytes{};
  bool then_close = false;  // else the connection stays open, and what is missing never comes
  std::string forever{};    // is sent again and again after that

  static Reply status(int status, const std::string& headers = {});
};

// Called by the receiver's thread.
using Behaviour = std::function<Reply(const ReceivedMessage& message)>;

class Receiver {
 public:
  explicit Receiver(Behaviour behaviour);
  ~Receiver();
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  void behave(Behaviour behaviour);
  std::uint16_t port() const { return port_; }
  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/scans?key=hidden"; }
  // All that was received as a whole, whatever was answered.
  std::vector<ReceivedMessage> received() const;
  std::vector<std::string> event_ids() const;

 private:
  struct Peer {
    FileDescriptor socket;
    std::string text;
    std::string repeated;
  };
  void serve();
  bool attend(Peer& peer);
  bool answer(Peer& peer, const ReceivedMessage& message);

  std::uint16_t port_ = 0;
  FileDescriptor listener_;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  Behaviour behaviour_;
  std::vector<ReceivedMessage> received_;
  std::vector<std::unique_ptr<Peer>> peers_;
  std::thread thread_;
};

// A socket that listens at a free port of this machine, which is given.
FileDescriptor listen_anywhere(std::uint16_t& port);

}  // namespace traygauge::test
