#include "tests/firmware/fleet/broker_process.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "firmware/base/file_descriptor.hpp"
#include "tests/firmware/webhook/receiver.hpp"

namespace traygauge::test {
namespace {

constexpr const char* kProgram = "/usr/sbin/mosquitto";

bool answers(std::uint16_t port) {
  const FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return ::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
}

}  // namespace

bool BrokerProcess::is_installed() {
  return ::access(kProgram, X_OK) == 0;
}

BrokerProcess::BrokerProcess(const std::string& lines) : lines_(lines) {
  { const FileDescriptor free = listen_anywhere(port_); }
  for (std::size_t at = 0; (at = lines_.find("FOLDER", at)) != std::string::npos;)
    lines_.replace(at, 6, folder().string());
  start();
}

void BrokerProcess::start() {
  const std::string config = folder() / "mosquitto.conf";
  // Started by root it would become a user who reads nothing of ours.
  std::ofstream(config) << "user root\nlistener " << port_ << " 127.0.0.1\n" << lines_;
  process_.start({kProgram, "-c", config});
  for (int i = 0; i < 1000; ++i) {
    if (answers(port_)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  throw std::runtime_error("mosquitto does not start: " + log());
}

}  // namespace traygauge::test
