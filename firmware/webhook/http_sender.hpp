// Sends one message after another by HTTP, without ever blocking.
#pragma once

#include <poll.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"

namespace traygauge {

struct HttpSenderParams {
  std::string url;    // http or https
  std::string shown;  // what failures call the receiver
  // Certificates that alone are trusted; none: those in `trusted_folder`.
  std::optional<std::filesystem::path> trusted_file;
  // A folder with a link for each certificate, of which only the one that is needed is read: the file with
  // all of them costs 30 ms and 1 MiB at each connection.
  std::filesystem::path trusted_folder = "/etc/ssl/certs";
  std::chrono::milliseconds connect_within{5000};  // the name's look-up included
  std::chrono::milliseconds answer_within{15000};  // all in all
  std::size_t max_answer_bytes = 64UL * 1024;      // head and body; the rest is not read
};

struct SendOutcome {
  int status = 0;       // of HTTP; 0: no answer
  std::string problem;  // where there is no answer: why, in words for people
};

// Follows no redirect, uses no proxy, verifies every certificate. Used by one thread.
class HttpSender {
 public:
  static Expected<HttpSender> create(HttpSenderParams params);
  HttpSender(HttpSender&& other) noexcept;
  HttpSender& operator=(HttpSender&& other) noexcept;
  // What is under way is broken off; whether it arrived stays unknown.
  ~HttpSender();

  // While nothing is under way. Each header is "Name: value". False where libcurl lacks memory.
  bool start(std::string body, const std::vector<std::string>& headers);
  bool is_busy() const;

  // What the loop waits for, and until when at most; none: as long as it likes.
  void add_descriptors(std::vector<pollfd>& descriptors) const;
  std::optional<std::chrono::milliseconds> timeout() const;
  // Gets on with what is under way; the outcome once it is known.
  std::optional<SendOutcome> attend();

 private:
  class Transfer;
  explicit HttpSender(std::unique_ptr<Transfer> transfer);

  std::unique_ptr<Transfer> transfer_;
};

}  // namespace traygauge
