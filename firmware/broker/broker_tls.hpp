// How a connection to a broker is encrypted, and who is believed.
#pragma once

#include <memory>
#include <string>

#include "firmware/base/expected.hpp"
#include "firmware/broker/broker_config.hpp"

struct ssl_ctx_st;

namespace traygauge {

// TLS 1.2 or later. The broker's certificate has to be valid for the host's name, though libmosquitto is
// given an address: it would look names up itself and hold its caller meanwhile.
class BrokerTls {
 public:
  // The failure names key and file.
  static Expected<std::unique_ptr<BrokerTls>> create(const BrokerConfig& config);
  BrokerTls(const BrokerTls&) = delete;
  BrokerTls& operator=(const BrokerTls&) = delete;

  ssl_ctx_st* context() const { return context_.get(); }

  // Why the broker's certificate was not believed since forget(); empty: it was, or none came.
  const std::string& distrust() const { return distrust_; }
  void forget() { distrust_.clear(); }
  // Whether this program's own certificate has ended, as a sentence; empty: it has not.
  std::string own_end() const;

 private:
  struct Free {
    void operator()(ssl_ctx_st* context) const;
  };
  struct Callbacks;

  explicit BrokerTls(const BrokerConfig& config);
  Expected<void> trust();
  Expected<void> identify();

  BrokerConfig config_;
  std::unique_ptr<ssl_ctx_st, Free> context_;
  bool is_literal_ = false;  // the host
  std::string distrust_;
};

}  // namespace traygauge
