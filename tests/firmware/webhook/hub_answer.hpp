// What a hub that the test runs itself answers.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <string>

#include "firmware/base/file_descriptor.hpp"
#include "firmware/hub/hub.hpp"

namespace traygauge::test {

// Head and body of the answer to GET `target`; the hub is stepped until it has come. Empty: no connection.
inline std::string answer_of(Hub& hub, const std::string& target) {
  const std::string addresses = hub.web()->addresses();
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(addresses.substr(addresses.rfind(':') + 1))));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    return {};
  const std::string request = "GET " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  if (::send(socket.number(), request.data(), request.size(), MSG_NOSIGNAL) < 0) return {};
  std::string text;
  char buffer[65536];
  for (;;) {
    hub.step(std::chrono::milliseconds(5));
    const ssize_t count = ::recv(socket.number(), buffer, sizeof(buffer), MSG_DONTWAIT);
    if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EAGAIN)) return text;
  }
}

}  // namespace traygauge::test
