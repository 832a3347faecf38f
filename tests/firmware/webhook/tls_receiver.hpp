// A receiver by https with a certificate of its own.
#pragma once

#include <openssl/ssl.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge::test {

template <auto free>
struct FreeBy {
  template <class Thing>
  void operator()(Thing* thing) const {
    free(thing);
  }
};

// Signed by itself, made anew each time.
class Certificate {
 public:
  // Valid from an hour ago on, until `valid_s` from now.
  explicit Certificate(const std::string& host, int valid_s = 3600);
  void write(const std::filesystem::path& file) const;
  void write_key(const std::filesystem::path& file) const;
  // Under the name by which OpenSSL looks for it.
  void link_into(const std::filesystem::path& folder) const;

  X509* certificate() const { return certificate_.get(); }
  EVP_PKEY* key() const { return key_.get(); }

 private:
  std::unique_ptr<EVP_PKEY, FreeBy<EVP_PKEY_free>> key_;
  std::unique_ptr<X509, FreeBy<X509_free>> certificate_;
};

// Answers 200 to whatever it can read.
class TlsReceiver {
 public:
  explicit TlsReceiver(const Certificate& certificate);
  ~TlsReceiver();
  TlsReceiver(const TlsReceiver&) = delete;
  TlsReceiver& operator=(const TlsReceiver&) = delete;
  std::uint16_t port() const { return port_; }
  // How many requests it answered.
  int answered() const { return answered_; }

 private:
  void serve();

  std::uint16_t port_ = 0;
  FileDescriptor listener_;
  std::unique_ptr<SSL_CTX, FreeBy<SSL_CTX_free>> context_;
  std::atomic<bool> stop_{false};
  std::atomic<int> answered_{0};
  std::thread thread_;
};

}  // namespace traygauge::test
