#include "tests/firmware/webhook/receiver.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace traygauge::test {

FileDescriptor listen_anywhere(std::uint16_t& port) {
  FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
      ::listen(socket.number(), 16) != 0 ||
      ::getsockname(socket.number(), reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("the test cannot listen");
  port = ntohs(address.sin_port);
  return socket;
}

std::string ReceivedMessage::header(const std::string& name) const {
  const std::string begin = "\r\n" + name + ": ";
  const std::size_t at = head.find(begin);
  if (at == std::string::npos) return {};
  const std::size_t value = at + begin.size();
  return head.substr(value, head.find("\r\n", value) - value);
}

Reply Reply::status(int status, const std::string& headers) {
  std::string text = "HTTP/1.1 ";
  text += std::to_string(status) + " So\r\nContent-Length: 2\r\n" + headers + "\r\nok";
  return {text};
}

Receiver::Receiver(Behaviour behaviour)
    : listener_(listen_anywhere(port_)), behaviour_(std::move(behaviour)), thread_([this] { serve(); }) {}

Receiver::~Receiver() {
  stop_ = true;
  thread_.join();
}

void Receiver::behave(Behaviour behaviour) {
  const std::lock_guard lock(mutex_);
  behaviour_ = std::move(behaviour);
}

std::vector<ReceivedMessage> Receiver::received() const {
  const std::lock_guard lock(mutex_);
  return received_;
}

std::vector<std::string> Receiver::event_ids() const {
  std::vector<std::string> ids;
  for (const ReceivedMessage& message : received()) ids.push_back(message.event_id());
  return ids;
}

void Receiver::serve() {
  while (!stop_) {
    std::vector<pollfd> descriptors{{listener_.number(), POLLIN, 0}};
    bool repeats = false;
    for (const auto& peer : peers_) {
      descriptors.push_back({peer->socket.number(), POLLIN, 0});
      repeats = repeats || !peer->repeated.empty();
    }
    ::poll(descriptors.data(), descriptors.size(), repeats ? 0 : 10);
    for (std::size_t i = peers_.size(); i > 0; --i) {
      Peer& peer = *peers_[i - 1];
      const bool is_ready = descriptors[i].revents != 0;
      bool stays = !is_ready || attend(peer);
      if (stays && !peer.repeated.empty())
        stays = ::send(peer.socket.number(), peer.repeated.data(), peer.repeated.size(),
                       MSG_NOSIGNAL | MSG_DONTWAIT) >= 0 ||
                errno == EAGAIN;
      if (!stays) peers_.erase(peers_.begin() + static_cast<std::ptrdiff_t>(i) - 1);
    }
    if (descriptors[0].revents != 0) {
      auto peer = std::make_unique<Peer>();
      peer->socket = FileDescriptor(::accept4(listener_.number(), nullptr, nullptr, SOCK_CLOEXEC));
      if (peer->socket.is_open()) peers_.push_back(std::move(peer));
    }
  }
}

// Whether the connection stays.
bool Receiver::attend(Peer& peer) {
  char buffer[65536];
  const ssize_t count = ::recv(peer.socket.number(), buffer, sizeof(buffer), MSG_DONTWAIT);
  if (count <= 0) return false;
  peer.text.append(buffer, static_cast<std::size_t>(count));
  const std::size_t end = peer.text.find("\r\n\r\n");
  if (end == std::string::npos) return true;
  ReceivedMessage message{peer.text.substr(0, end + 2), {}};
  const std::size_t length = std::strtoul(message.header("Content-Length").c_str(), nullptr, 10);
  if (peer.text.size() < end + 4 + length) return true;
  message.body = peer.text.substr(end + 4, length);
  peer.text.erase(0, end + 4 + length);
  return answer(peer, message);
}

bool Receiver::answer(Peer& peer, const ReceivedMessage& message) {
  const std::lock_guard lock(mutex_);
  received_.push_back(message);
  const Reply reply = behaviour_(message);
  ::send(peer.socket.number(), reply.bytes.data(), reply.bytes.size(), MSG_NOSIGNAL);
  peer.repeated = reply.forever;
  return !reply.then_close;
}

}  // namespace traygauge::test
