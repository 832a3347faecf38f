// Looks a host's name up without holding its caller, however long the name server takes.
#pragma once

#include <poll.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"

namespace traygauge {

// Literal addresses, of which there may be several for a name, in the order in which they should be tried.
using Addresses = std::vector<std::string>;

class NameLookup {
 public:
  explicit NameLookup(std::string host) : host_(std::move(host)) {}

  bool is_running() const { return request_ != nullptr; }
  // A thread that asks is left behind, not waited for, where the name server hangs; there is one at a time.
  Expected<void> start();
  void add_descriptors(std::vector<pollfd>& descriptors) const;
  // None while it is not answered.
  std::optional<Expected<Addresses>> take();

 private:
  struct Request;

  std::string host_;
  std::shared_ptr<Request> request_;
};

}  // namespace traygauge
