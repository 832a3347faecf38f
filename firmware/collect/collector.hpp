// Stores what hubs publish, each event once, and tells them so by receipts.
#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/broker/broker_link.hpp"
#include "firmware/collect/collect_config.hpp"
#include "firmware/collect/collected_store.hpp"

namespace traygauge {

struct CollectorCounts {  // since the start
  std::uint64_t stored = 0;
  std::uint64_t repeated = 0;
  std::uint64_t twins = 0;
  std::uint64_t ignored = 0;  // messages that are no events, or too long
  std::uint64_t batches = 0;
};

// Used by a loop: add_descriptors(), timeout(), attend().
class Collector {
 public:
  // The failure names key and file.
  static Expected<std::unique_ptr<Collector>> start(const CollectConfig& config, BrokerLimits limits = {});

  // What has to be known of the configuration, for the log; empty: nothing.
  std::string warning() const { return link_->warning(); }
  void add_descriptors(std::vector<pollfd>& descriptors) const { link_->add_descriptors(descriptors); }
  std::chrono::milliseconds timeout() const { return link_->timeout(); }
  // Everything that has come together is one commit, then receipts. Returns sentences for the log.
  std::vector<std::string> attend();

  const CollectorCounts& counts() const { return counts_; }
  bool is_connected() const { return link_->is_connected(); }
  CollectedStore& store() { return *store_; }

 private:
  Collector(CollectConfig config, std::unique_ptr<BrokerLink> link, std::unique_ptr<CollectedStore> store);
  void take(std::vector<BrokerMessage> messages);
  void give_receipts(const std::vector<CollectedEvent>& events);
  void say(const std::string& problem);

  CollectConfig config_;
  std::unique_ptr<BrokerLink> link_;
  std::unique_ptr<CollectedStore> store_;
  CollectorCounts counts_;
  std::string last_said_;
  std::vector<std::string> sentences_;
};

}  // namespace traygauge
