// The fleet as part of a hub: what its log, /health and /metrics say.
#include <gtest/gtest.h>

#include "firmware/hub/hub.hpp"
#include "tests/firmware/fleet/broker_process.hpp"
#include "tests/firmware/fleet/fleet_rig.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/firmware/webhook/hub_answer.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;

class FleetHubTest : public testing::Test {
 protected:
  void start(const std::optional<FleetConfig>& fleet) {
    hub_.reset();
    log_.clear();
    HubParams params;
    params.socket = folder_.path() / "hub";
    params.store.options.file = folder_.path() / "results.db";
    params.web.config.listen = {"127.0.0.1:0"};
    params.fleet = fleet;
    params.fleet_limits = quick_fleet_limits();
    auto hub = Hub::start(params, [this](const std::string& sentence) { log_ += sentence + "\n"; });
    ASSERT_TRUE(hub.ok()) << hub.failure();
    hub_ = std::move(*hub);
  }
  void put(std::uint64_t number) {
    ASSERT_TRUE(hub_->store().store()->scans().put(sample_document(number), at(kMorningMs)).ok());
  }
  std::string get(const std::string& target) { return answer_of(*hub_, target); }
  bool answers(const std::string& target, const std::string& text) {
    const auto end = std::chrono::steady_clock::now() + milliseconds(8000);
    while (std::chrono::steady_clock::now() < end) {
      if (get(target).find(text) != std::string::npos) return true;
      if (listener_) listener_->step();
    }
    return false;
  }

  MemoryFolder folder_;
  std::unique_ptr<Hub> hub_;
  std::optional<Listener> listener_;
  std::string log_;
};

TEST_F(FleetHubTest, HealthWarnsAndFiguresCount) {
  TRAYGAUGE_NEED_BROKER();
  BrokerProcess broker;
  const FleetConfig config = fleet_config(broker.port());
  listener_.emplace(config.broker);
  start(config);
  EXPECT_TRUE(answers("/metrics", "traygauge_fleet_connected 1\n"));
  EXPECT_TRUE(answers("/health", R"({"name":"fleet","status":"ok","message":null})"));
  put(1);
  EXPECT_TRUE(answers("/health",
                      R"({"name":"fleet","status":"warning","message":"Results wait for the fleet: 1. )"
                      "No collector answered with a receipt behind mqtt://127.0.0.1:"))
      << get("/health");
  EXPECT_TRUE(answers("/metrics", "traygauge_fleet_waiting 1\n"));
  listener_->give_receipts();
  EXPECT_TRUE(answers("/metrics", "traygauge_fleet_delivered_total 1\n"));
  EXPECT_TRUE(answers("/health", R"({"name":"fleet","status":"ok","message":null})"));
  broker.kill();
  EXPECT_TRUE(answers("/metrics", "traygauge_fleet_connected 0\n"));
  put(2);
  EXPECT_TRUE(answers("/health", "Results wait for the fleet: 1. mqtt://127.0.0.1:"));
  start(std::nullopt);
  EXPECT_NE(log_.find("No fleet is configured any more: 1 scans and corrections"), std::string::npos) << log_;
  EXPECT_EQ(get("/health").find("fleet"), std::string::npos);
}

TEST_F(FleetHubTest, SaysThatTheWayIsNotEncrypted) {
  FleetConfig config = fleet_config(1);
  config.broker.host = "192.0.2.1";
  start(config);
  EXPECT_NE(log_.find("The way to the broker mqtt://192.0.2.1:1 is not encrypted"), std::string::npos)
      << log_;
  start(fleet_config(1));
  EXPECT_EQ(log_.find("not encrypted"), std::string::npos) << log_;
}

}  // namespace
}  // namespace traygauge::test
