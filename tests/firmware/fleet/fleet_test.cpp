// What a fleet tells through a real broker, and what becomes of it where broker or collector fail.
#include "firmware/fleet/fleet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "firmware/broker/receipts.hpp"
#include "firmware/broker/topic.hpp"
#include "firmware/webhook/webhook_message.hpp"
#include "tests/firmware/fleet/broker_process.hpp"
#include "tests/firmware/fleet/fleet_rig.hpp"
#include "tests/firmware/fleet/strange_broker.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/firmware/webhook/receiver.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;
using Ids = std::vector<std::string>;

constexpr const char* kStatus = "traygauge/v1/kitchen/status";
constexpr const char* kReceipt = "traygauge/v1/kitchen/receipt";

// A rig and a listener at one broker, both connected.
class FleetTest : public testing::Test {
 protected:
  void SetUp() override { TRAYGAUGE_NEED_BROKER(); }
  void start(const std::string& broker_lines = "allow_anonymous true\npersistence false\n") {
    broker_.emplace(broker_lines);
    config_ = fleet_config(broker_->port());
    listener_.emplace(config_.broker);
    rig_.emplace(config_);
    rig_->add(*listener_);
    ASSERT_TRUE(rig_->run_until([this] { return listener_->is_connected() && rig_->fleet().is_connected(); }))
        << broker_->log() << rig_->log();
  }
  bool all_delivered() {
    return rig_->run_until([this] { return rig_->waiting() == 0; }, milliseconds(20000));
  }

  std::optional<BrokerProcess> broker_;
  FleetConfig config_;
  std::optional<Listener> listener_;
  std::optional<FleetRig> rig_;
};

TEST_F(FleetTest, AScanIsDeliveredByItsReceiptAlone) {
  start();
  rig_->put(1);
  rig_->correct(1, "bulgur");
  ASSERT_TRUE(rig_->run_until([this] { return listener_->ids.size() == 2; }));
  EXPECT_EQ(listener_->ids, (Ids{"kitchen-1", "kitchen-1.correction-1.1795765200000"}));
  rig_->run_for(milliseconds(100));
  EXPECT_EQ(rig_->waiting(), 2) << "the broker's acknowledgement is no receipt";
  const auto delivery = rig_->store().deliveries().due(kFleetDestination, kMorningMs, 1);
  EXPECT_EQ(listener_->last("traygauge/v1/kitchen/scan"),
            (*webhook_message(rig_->store(), delivery->front()))->body);
  EXPECT_NE(listener_->last("traygauge/v1/kitchen/correction").find(R"("event":"correction")"),
            std::string::npos);
  listener_->say(kReceipt, R"({"ids":["kitchen-1","kitchen-1.correction-1.1795765200000","nobody"]})");
  ASSERT_TRUE(all_delivered());
  EXPECT_EQ(rig_->state().delivered, 2U);
  rig_->run_for(milliseconds(50));
  rig_->restart();
  EXPECT_EQ(rig_->waiting(), 0) << "it was noted";
  EXPECT_EQ(rig_->log(), "");
  EXPECT_LT(rig_->longest_call(), milliseconds(50));
}

TEST_F(FleetTest, TheBrokersWordIsEnoughWhereTheFileSaysSo) {
  start();
  config_.delivery = FleetDelivery::broker;
  rig_.emplace(config_);
  for (std::uint64_t number = 1; number <= 100; ++number) rig_->put(number);
  EXPECT_TRUE(all_delivered());
  EXPECT_EQ(rig_->state().published, 100U);
}

TEST_F(FleetTest, BirthWillAndHealthAreRetained) {
  start();
  rig_->run_for(milliseconds(50));
  Listener later(config_.broker);
  rig_->add(later);
  ASSERT_TRUE(rig_->run_until([&] { return !later.last("traygauge/v1/kitchen/health").empty(); }));
  EXPECT_EQ(later.last(kStatus), "online");
  EXPECT_EQ(later.last("traygauge/v1/kitchen/health"), rig_->health);
  rig_->health = R"({"status":"warning","parts":[]})";
  EXPECT_TRUE(rig_->run_until([&] { return later.last("traygauge/v1/kitchen/health") == rig_->health; }));
  rig_->stop();
  for (int i = 0; i < 500 && later.last(kStatus) != "offline"; ++i) {
    later.step();
    std::this_thread::sleep_for(milliseconds(5));
  }
  EXPECT_EQ(later.last(kStatus), "offline");
}

TEST_F(FleetTest, WithoutReceiptsEverythingIsSentAgainEverLater) {
  start();
  rig_->put(1);
  const int rounds = rig_->run_for(milliseconds(2000));
  EXPECT_GE(listener_->ids.size(), 3U);
  EXPECT_LE(listener_->ids.size(), 7U) << "300 ms for a receipt and 20 to 200 ms of waiting";
  EXPECT_LT(rounds, 800) << "the loop goes round without need";
  EXPECT_NE(rig_->state().last_failure.find("No collector answered with a receipt"), std::string::npos);
  EXPECT_NE(rig_->fleet().trouble().find("Results wait for the fleet: 1. No collector"), std::string::npos)
      << rig_->fleet().trouble();
  listener_->give_receipts();
  EXPECT_TRUE(all_delivered());
  EXPECT_EQ(rig_->fleet().trouble(), "");
  EXPECT_TRUE(rig_->logged("results are delivered again")) << rig_->log();
}

TEST_F(FleetTest, AMessageThatNobodyTakesIsToldAndLetsOthersPass) {
  start("allow_anonymous true\npersistence false\nmessage_size_limit 100000\n");
  listener_->give_receipts();
  rig_->put_long(1, 200'000);
  for (std::uint64_t number = 2; number <= 40; ++number) rig_->put(number);
  ASSERT_TRUE(rig_->run_until([this] { return rig_->waiting() == 1; }));
  // Only beside others that are receipted can it be known to be the one.
  std::uint64_t number = 40;
  ASSERT_TRUE(rig_->run_until([&] {
    if (rig_->waiting() == 1) rig_->put(++number);
    return !rig_->state().undeliverable.empty();
  })) << rig_->state().failed_attempts;
  EXPECT_EQ(rig_->state().undeliverable.begin()->first, "kitchen-1");
  EXPECT_NE(rig_->fleet().trouble().find("kitchen-1 (20"), std::string::npos) << rig_->fleet().trouble();
  EXPECT_TRUE(rig_->logged("kitchen-1 (20")) << rig_->log();
  EXPECT_GE(rig_->waiting(), 1);
}

TEST_F(FleetTest, ResultsOfAMebibyteAreDelivered) {
  start();
  listener_->give_receipts();
  for (std::uint64_t number = 1; number <= 3; ++number) rig_->put_long(number, 1'000'000);
  EXPECT_TRUE(all_delivered());
}

TEST_F(FleetTest, StrangeMessagesChangeNothing) {
  start();
  rig_->put(1);
  ASSERT_TRUE(rig_->run_until([this] { return listener_->ids.size() == 1; }));
  const std::string nested = std::string(30'000, '[');
  for (const std::string& payload :
       {std::string(), std::string("kitchen-1"), std::string(R"({"ids":"kitchen-1"})"), nested,
        std::string(R"({"ids":[1,{"a":[]}]})"), std::string(R"({"ids":["kitchen-1"],"x":)"),
        R"({"ids":["kitchen-1")" + std::string(200'000, ' ') + "]}", std::string("\0\xff", 2)}) {
    listener_->say(kReceipt, payload);
  }
  ASSERT_TRUE(rig_->run_until([this] { return rig_->state().ignored == 8; })) << rig_->state().ignored;
  EXPECT_EQ(rig_->waiting(), 1);
  EXPECT_TRUE(rig_->fleet().is_connected());
}

TEST_F(FleetTest, ABrokerThatIsKilledLosesNothing) {
  start();
  listener_->give_receipts();
  std::mt19937 random(random_seed());
  std::uint64_t last = 0;
  for (int kill = 0; kill < 6; ++kill) {
    for (int i = 0; i < 40; ++i) {
      rig_->put(++last);
      if (random() % 4 == 0) rig_->step();
    }
    broker_->kill();
    rig_->run_for(milliseconds(random() % 60));
    if (kill % 2 == 0) rig_->restart();
    broker_->start();
    if (kill % 3 == 0) {
      ASSERT_TRUE(all_delivered()) << rig_->log();
    }
  }
  ASSERT_TRUE(all_delivered()) << rig_->log() << rig_->fleet().trouble();
  const std::set<std::string> once(listener_->ids.begin(), listener_->ids.end());
  EXPECT_EQ(once.size(), last);
  std::cout << last << " results, told " << listener_->ids.size() << " times" << std::endl;
}

TEST_F(FleetTest, AStoreThatIsAwayOrReplacedIsNoBusyLoop) {
  start();
  for (std::uint64_t number = 1; number <= 5; ++number) rig_->put(number);
  ASSERT_TRUE(rig_->run_until([this] { return listener_->ids.size() == 5; }));
  const std::filesystem::path file = rig_->store().database().file();
  rig_->store().database().note_damage("for a test");
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);  // in its place nothing can be opened
  rig_->hub_store().tend(std::chrono::steady_clock::now());
  ASSERT_EQ(rig_->hub_store().store(), nullptr);
  EXPECT_LT(rig_->run_for(milliseconds(500)), 200);
  std::filesystem::remove(file);
  rig_->hub_store().tend(std::chrono::steady_clock::now() + std::chrono::seconds(6));
  ASSERT_NE(rig_->hub_store().store(), nullptr);
  rig_->put(11);
  listener_->give_receipts();
  EXPECT_TRUE(all_delivered());
  EXPECT_EQ(listener_->ids.back(), "kitchen-11");
}

TEST_F(FleetTest, HomeAssistantIsToldAgainAtItsBirthAndForgets) {
  start();
  config_.home_assistant = true;
  rig_.emplace(config_);
  rig_->add(*listener_);
  const std::string topic = "homeassistant/sensor/traygauge_kitchen/volume/config";
  const auto count = [&](bool is_empty) {
    return std::count_if(listener_->heard.begin(), listener_->heard.end(), [&](const BrokerMessage& message) {
      return message.topic == topic && message.payload.empty() == is_empty;
    });
  };
  ASSERT_TRUE(rig_->run_until([&] { return count(false) == 1; }));
  const auto told = nlohmann::json::parse(listener_->last(topic));
  EXPECT_EQ(told.at("state_topic"), "traygauge/v1/kitchen/scan");
  EXPECT_EQ(told.at("unique_id"), "traygauge_kitchen_volume");
  listener_->say("homeassistant/status", "online");
  ASSERT_TRUE(rig_->run_until([&] { return count(false) == 2; }));
  config_.home_assistant = false;
  rig_.emplace(config_);
  rig_->add(*listener_);
  ASSERT_TRUE(rig_->run_until([&] { return count(true) == 1; }));
}

struct StrangeCase {
  std::string greeting;
  bool then_closes;
  const char* problem;
};

TEST(FleetStrange, EveryStrangeBrokerIsToldAndTriedEverLater) {
  const std::string taken("\x20\x02\x00\x00", 4);
  const std::vector<StrangeCase> cases{
      {"", false, "did not answer in time"},
      {"", true, "closed the connection without an answer"},
      {"HTTP/1.1 400 Bad Request\r\n\r\n", true, "closed the connection without an answer"},
      {std::string(4000, '\xff'), false, "is not MQTT 3.1.1"},
      {std::string("\x30\xff\xff\xff\x7f", 5), false, "did not answer in time"},
      {std::string("\x20\x02\x00\x03", 4), false, "out of service"},
      {std::string("\x20\x02\x00\x02", 4), false, "does not take a client called traygauge-kitchen"},
      {std::string("\x20\x02\x00\x05", 4), false, "takes nobody without a user; set fleet.user"},
      {taken, true, "closed the connection. Where it does so again"},
      {taken, false, "No collector answered"},
      {taken + std::string("\0\0garbage", 9), false, "is not MQTT 3.1.1"},
      {taken + std::string("\x90\x03\x00\x01\x80", 5), false, "does not let this client listen"},
  };
  for (const StrangeCase& strange : cases) {
    StrangeBroker broker(strange.greeting, strange.then_closes);
    FleetRig rig(fleet_config(broker.port()));
    rig.put(1);
    const int rounds = rig.run_for(milliseconds(1500));
    EXPECT_TRUE(rig.logged(strange.problem)) << strange.problem << "\n" << rig.log();
    EXPECT_LE(broker.connections(), 20) << strange.problem << ": no back-off";
    EXPECT_LT(rounds, 600) << strange.problem << ": the loop goes round without need";
    EXPECT_EQ(rig.waiting(), 1);
    EXPECT_LT(rig.longest_call(), milliseconds(50)) << strange.problem;
    ASSERT_TRUE(rig.run_until([&] { return !rig.fleet().trouble().empty(); })) << strange.problem;
  }
}

TEST(FleetStrange, NobodyIsThere) {
  std::uint16_t port = 0;
  { const FileDescriptor gone = listen_anywhere(port); }
  FleetRig rig(fleet_config(port));
  rig.put(1);
  EXPECT_LT(rig.run_for(milliseconds(700)), 300);
  EXPECT_TRUE(rig.logged("takes no connection (Connection refused)")) << rig.log();
  FleetConfig config = fleet_config(port);
  config.broker.host = "no-such-name.invalid";
  FleetRig other(config);
  ASSERT_TRUE(other.run_until([&] { return !other.log().empty(); }, milliseconds(30000)));
  EXPECT_LT(other.longest_call(), milliseconds(50));
}

TEST(FleetWindow, ForgetsNothingThatItWasNotAskedFor) {
  FleetWindow window;
  window.add({{1, 0}, "a", 10, 0, 7, {}});
  window.add({{2, 0}, "b", 5, 0, 8, {}});
  EXPECT_EQ(window.bytes(), 15U);
  EXPECT_TRUE(window.holds({2, 0}));
  EXPECT_FALSE(window.take_event("c"));
  EXPECT_EQ(window.take_number(8)->event_id, "b");
  EXPECT_FALSE(window.holds({2, 0}));
  EXPECT_EQ(window.take_event("a")->key, (DeliveryKey{1, 0}));
  EXPECT_TRUE(window.is_empty());
  EXPECT_EQ(window.bytes(), 0U);
}

TEST(Topics, NoTextLeavesItsLevel) {
  EXPECT_EQ(topic_of("a/b", "kitchen-1", "scan"), "a/b/v1/kitchen-1/scan");
  EXPECT_EQ(topic_level(std::string("a/b+c#d\0e $.%\xff", 14)), "a%2Fb%2Bc%23d%00e%20%24%2E%25%FF");
  EXPECT_EQ(split_topic("a/b", "a/b/v1/x%2Fy/scan")->level, "x%2Fy");
  for (const char* const other : {"a/b", "a/b/v1/x", "a/b/v1//scan", "a/b/v2/x/scan", "a/bv1/x/scan",
                                  "a/b/v1/x/scan/more", "c/v1/x/scan"})
    EXPECT_FALSE(split_topic("a/b", other)) << other;
  for (const char* const bad : {"", "/a", "a/", "a//b", "a+b", "#", "a b", "$SYS"})
    EXPECT_FALSE(is_topic_prefix(bad)) << bad;
  EXPECT_TRUE(is_topic_prefix("canteens/north-1"));
}

TEST(Receipts, AreSplitWhereTheyBecomeLong) {
  std::vector<std::string> ids;
  for (int i = 0; i < 5000; ++i) ids.push_back("kitchen-\"\xff" + std::to_string(i));
  std::span<const std::string> left(ids);
  std::size_t count = 0;
  while (!left.empty()) {
    const std::string receipt = make_receipt(left);
    EXPECT_LE(receipt.size(), kMaxReceiptBytes);
    count += parse_receipt(receipt)->size();
  }
  EXPECT_EQ(count, ids.size());
}

}  // namespace
}  // namespace traygauge::test
