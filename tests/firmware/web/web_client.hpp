// A client that sends what it is told, byte by byte, and reads what comes.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace traygauge::test {

struct WebReply {
  int status = 0;
  std::vector<std::pair<std::string, std::string>> headers;  // names in lower case
  std::string body;                                          // without chunks' lengths

  // All of that name, joined by '|'.
  std::string header(std::string_view name) const;
};

class WebClient {
 public:
  using Milliseconds = std::chrono::milliseconds;

  explicit WebClient(std::uint16_t port, const char* address = "127.0.0.1");
  explicit WebClient(const std::filesystem::path& socket);
  WebClient(WebClient&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), received_(std::move(other.received_)) {}
  WebClient& operator=(WebClient&&) = delete;
  WebClient(const WebClient&) = delete;
  WebClient& operator=(const WebClient&) = delete;
  ~WebClient();

  bool is_connected() const { return socket_ >= 0; }
  // False where the other end took no more within five seconds, or is gone.
  bool send(std::string_view bytes);
  // None where no whole reply came in time.
  std::optional<WebReply> receive(bool is_head = false, Milliseconds timeout = Milliseconds(5000));
  // send() and receive() of one request; `head` has lines without their ends.
  std::optional<WebReply> ask(std::string_view method, std::string_view target,
                              const std::vector<std::string>& fields = {}, std::string_view body = {});
  // Reads until `text` came; what came so far, up to its end. Empty where it did not come in time.
  std::string receive_until(std::string_view text, Milliseconds timeout = Milliseconds(5000));
  // Reads and drops what comes until the other end closes.
  bool is_closed_within(Milliseconds timeout);
  // A small receive buffer, so that a reply does not fit in the kernel's.
  int descriptor() const { return socket_; }

 private:
  bool read_more(std::chrono::steady_clock::time_point end);

  int socket_ = -1;
  bool is_closed_ = false;
  std::string received_;
};

}  // namespace traygauge::test
