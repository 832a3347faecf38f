#include "firmware/broker/name_lookup.hpp"

#include <netdb.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <thread>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge {

// Both the thread and who waits hold it; the thread is the last where nobody waits any more.
struct NameLookup::Request {
  std::string host;
  FileDescriptor done;
  std::atomic<bool> is_answered{false};
  int failure = 0;  // getaddrinfo's
  Addresses addresses;

  void ask();
};

void NameLookup::Request::ask() {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  failure = ::getaddrinfo(host.c_str(), nullptr, &hints, &found);
  for (const addrinfo* entry = found; failure == 0 && entry != nullptr; entry = entry->ai_next) {
    std::array<char, NI_MAXHOST> text{};
    const int unnamed = ::getnameinfo(entry->ai_addr, entry->ai_addrlen, text.data(), text.size(), nullptr, 0,
                                      NI_NUMERICHOST);
    if (unnamed == 0) addresses.emplace_back(text.data());
  }
  if (found != nullptr) ::freeaddrinfo(found);
  is_answered = true;
  const std::uint64_t one = 1;
  // Nobody can be told where this fails; who waits looks again when its time is over.
  if (::write(done.number(), &one, sizeof(one)) < 0) return;
}

Expected<void> NameLookup::start() {
  auto request = std::make_shared<Request>();
  request->host = host_;
  request->done = FileDescriptor(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!request->done.is_open())
    return Failure{"No name can be looked up: " + std::system_category().message(errno) + "."};
  try {
    std::thread([request] { request->ask(); }).detach();
  } catch (const std::system_error& error) {
    return Failure{std::string("No name can be looked up: ") + error.what() + "."};
  }
  request_ = std::move(request);
  return {};
}

void NameLookup::add_descriptors(std::vector<pollfd>& descriptors) const {
  if (request_ != nullptr) descriptors.push_back({request_->done.number(), POLLIN, 0});
}

std::optional<Expected<Addresses>> NameLookup::take() {
  if (request_ == nullptr || !request_->is_answered) return std::nullopt;
  const std::shared_ptr<Request> request = std::move(request_);
  request_ = nullptr;
  if (request->failure != 0 || request->addresses.empty())
    return Expected<Addresses>(Failure{
        "The name " + request->host + " cannot be looked up" +
        (request->failure != 0 ? std::string(" (") + ::gai_strerror(request->failure) + ")" : std::string()) +
        "; check it and the name server."});
  return Expected<Addresses>(std::move(request->addresses));
}

}  // namespace traygauge
