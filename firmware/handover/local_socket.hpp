// A Unix socket between station and hub, on one machine. Every wait has an end.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/base/expected.hpp"
#include "firmware/base/file_descriptor.hpp"

namespace traygauge {

using Milliseconds = std::chrono::milliseconds;

// One end of a connection; its descriptor never blocks.
class LocalConnection {
 public:
  LocalConnection() = default;
  explicit LocalConnection(FileDescriptor socket) : socket_(std::move(socket)) {}

  bool is_open() const { return socket_.is_open(); }
  int descriptor() const { return socket_.number(); }
  void close() { socket_.close(); }

  // What the kernel takes at once, in bytes.
  Expected<std::size_t> send_some(std::string_view bytes) const;
  // All of it within `timeout`, or a failure; part of it may then have been sent.
  Expected<void> send_all(std::string_view bytes, Milliseconds timeout) const;
  // What has come, after at most `timeout`; empty when nothing did. A closed peer is a failure.
  Expected<std::string> receive_some(Milliseconds timeout) const;

 private:
  FileDescriptor socket_;
};

Expected<LocalConnection> connect_local(const std::filesystem::path& path);

// Listens at a path for this user and group alone; a file that a killed predecessor left is replaced, a
// living one is respected. Removes the file at its end.
class LocalListener {
 public:
  static Expected<LocalListener> open(const std::filesystem::path& path);
  LocalListener(LocalListener&&) = default;
  LocalListener& operator=(LocalListener&&) = delete;
  LocalListener(const LocalListener&) = delete;
  LocalListener& operator=(const LocalListener&) = delete;
  ~LocalListener();

  int descriptor() const { return socket_.number(); }
  // Not open when nobody waits.
  Expected<LocalConnection> accept();

 private:
  LocalListener(FileDescriptor lock, FileDescriptor socket, std::filesystem::path path)
      : lock_(std::move(lock)), socket_(std::move(socket)), path_(std::move(path)) {}

  FileDescriptor lock_;
  FileDescriptor socket_;
  std::filesystem::path path_;
};

}  // namespace traygauge
