#include "firmware/hub/station_inbox.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "firmware/handover/hub_link.hpp"
#include "firmware/handover/told_drift.hpp"
#include "firmware/hub/hub.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/support/random_seed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

std::string document(const std::string& station, int number, const std::string& tray = "tray 12") {
  SampleScan scan;
  scan.id = {station, static_cast<std::uint64_t>(number)};
  scan.tray = tray;
  return sample_document(scan);
}

// A hub in a thread of its own.
class Inbox : public ::testing::Test {
 protected:
  void SetUp() override {
    HubParams params;
    params.socket = folder_.path() / "hub";
    params.store.options.file = folder_.path() / "results.db";
    params.inbox.hello_within = Milliseconds(100);
    params.inbox.max_connections = 4;
    auto hub = Hub::start(params, [this](const std::string& sentence) { log_ += sentence + "\n"; });
    ASSERT_TRUE(hub.ok()) << hub.failure();
    hub_ = std::move(*hub);
    thread_ = std::thread([this] {
      while (!stop_) hub_->step(Milliseconds(5));
    });
  }
  void TearDown() override { end(); }
  // After this, the hub belongs to the test's thread.
  void end() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

  HubLink link_of(const std::string& station) const {
    HubLinkParams params;
    params.socket = folder_.path() / "hub";
    params.station = station;
    params.program_version = "1.2.3";
    params.answer_timeout = Milliseconds(5000);
    params.retry_after = Milliseconds(0);
    return HubLink(params);
  }
  ScanCounts totals() {
    end();
    return hub_->store().store()->scans().totals().value().counts;
  }

  TemporaryFolder folder_;
  std::string log_;
  std::unique_ptr<Hub> hub_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// Who asks says no hello: a station of that name goes on.
TEST_F(Inbox, TellsADriftToWhoAsks) {
  HubLink link = link_of("kitchen");
  SampleScan scan;
  scan.scale_percent = -0.7;
  for (scan.id.number = 1; scan.id.number <= 20; ++scan.id.number)
    ASSERT_EQ(link.deliver(scan_id_text(scan.id), sample_document(scan)).answer, HubAnswer::stored);
  const auto told = ask_drift(folder_.path() / "hub", "kitchen", Milliseconds(5000));
  ASSERT_TRUE(told.ok()) << told.failure();
  ASSERT_EQ(told->size(), 3U);
  EXPECT_EQ(told->front().check, "scale_percent");
  EXPECT_EQ(told->front().median, -0.7);
  EXPECT_EQ(told->front().scans, 20U);
  EXPECT_NE(told->front().drift.find("0.70 % smaller"), std::string::npos) << told->front().drift;
  EXPECT_EQ(told->back().drift, "");
  const auto of_nobody = ask_drift(folder_.path() / "hub", "buffet", Milliseconds(5000));
  ASSERT_TRUE(of_nobody.ok()) << of_nobody.failure();
  EXPECT_TRUE(of_nobody->empty());
  EXPECT_TRUE(link.is_connected());
  EXPECT_EQ(link.deliver("kitchen-21", document("kitchen", 21)).answer, HubAnswer::stored);
  end();
  EXPECT_EQ(hub_->inbox().stations().size(), 1U);
  EXPECT_EQ(log_, "");
}

TEST_F(Inbox, StoresEachScanOnceHoweverOftenItComes) {
  HubLink link = link_of("kitchen");
  for (int round = 0; round < 3; ++round) {
    for (int i = 1; i <= 10; ++i)
      EXPECT_EQ(link.deliver("kitchen-" + std::to_string(i), document("kitchen", i)).answer,
                HubAnswer::stored);
  }
  EXPECT_EQ(totals().scans, 10);
}

TEST_F(Inbox, ServesSeveralStations) {
  HubLink first = link_of("kitchen");
  HubLink second = link_of("canteen");
  EXPECT_EQ(first.deliver("kitchen-1", document("kitchen", 1)).answer, HubAnswer::stored);
  EXPECT_EQ(second.deliver("canteen-1", document("canteen", 1)).answer, HubAnswer::stored);
  EXPECT_EQ(first.deliver("kitchen-2", document("kitchen", 2)).answer, HubAnswer::stored);
  EXPECT_EQ(totals().scans, 3);
  EXPECT_EQ(hub_->inbox().stations().size(), 2U);
  EXPECT_EQ(hub_->inbox().stations().at("kitchen").program, "1.2.3");
}

TEST_F(Inbox, AnotherDocumentOfTheSameIdIsSetAside) {
  HubLink link = link_of("kitchen");
  EXPECT_EQ(link.deliver("kitchen-1", document("kitchen", 1, "tray 12")).answer, HubAnswer::stored);
  const HubReply reply = link.deliver("kitchen-1", document("kitchen", 1, "tray 13"));
  EXPECT_EQ(reply.answer, HubAnswer::set_aside);
  EXPECT_FALSE(reply.text.empty());
  const ScanCounts found = totals();
  EXPECT_EQ(found.scans, 1);
  EXPECT_EQ(found.set_aside, 1);
}

TEST_F(Inbox, WhatCannotBeReadIsKeptAndSaid) {
  HubLink link = link_of("kitchen");
  for (const std::string damaged : {"", "{", "[]", "\xff\xfe", R"({"version":2})"})
    EXPECT_EQ(link.deliver("kitchen-1", damaged).answer, HubAnswer::set_aside) << damaged;
  EXPECT_EQ(totals().scans, 0);
  EXPECT_EQ(totals().set_aside, 5);
  EXPECT_NE(log_.find("set aside"), std::string::npos);
}

TEST_F(Inbox, AStationCannotTakeAnothersNumbers) {
  HubLink link = link_of("kitchen");
  EXPECT_EQ(link.deliver("canteen-1", document("canteen", 1)).answer, HubAnswer::set_aside);
  HubLink owner = link_of("canteen");
  EXPECT_EQ(owner.deliver("canteen-1", document("canteen", 1)).answer, HubAnswer::stored);
}

TEST_F(Inbox, KnowsWhatAStationDoesAndWhetherItIsThere) {
  {
    HubLink link = link_of("kitchen");
    link.tell({MessageType::state, R"({"state":"waiting"})", {}});
    link.tell({MessageType::state, "not json", {}});
    ASSERT_EQ(link.deliver("kitchen-1", document("kitchen", 1)).answer, HubAnswer::stored);
  }
  std::this_thread::sleep_for(Milliseconds(100));
  end();
  const LiveStation& live = hub_->inbox().stations().at("kitchen");
  EXPECT_EQ(live.state, R"({"state":"waiting"})");
  EXPECT_FALSE(live.is_connected);
}

TEST_F(Inbox, ClosesWhoSaysNothingAndWhoIsOneTooMany) {
  std::vector<LocalConnection> silent;
  for (int i = 0; i < 20; ++i) {
    auto connection = connect_local(folder_.path() / "hub");
    if (connection.ok()) silent.push_back(std::move(*connection));
  }
  std::this_thread::sleep_for(Milliseconds(300));
  HubLink link = link_of("kitchen");
  EXPECT_EQ(link.deliver("kitchen-1", document("kitchen", 1)).answer, HubAnswer::stored);
  for (LocalConnection& connection : silent) EXPECT_FALSE(connection.receive_some(Milliseconds(100)).ok());
}

// Damaged, cut and foreign bytes close their connection and touch nothing else.
TEST_F(Inbox, SurvivesGarbage) {
  std::mt19937 random(random_seed());
  HubLink link = link_of("kitchen");
  for (int run = 0; run < 300; ++run) {
    auto connection = connect_local(folder_.path() / "hub");
    if (!connection.ok()) continue;
    std::string bytes = encode({MessageType::hello, R"({"station":"canteen"})", {}});
    bytes += encode({MessageType::scan, R"({"id":"canteen-1"})", document("canteen", 1 + run)});
    for (int flips = static_cast<int>(random() % 4); flips > 0; --flips)
      bytes[random() % bytes.size()] ^= static_cast<char>(1U << (random() % 8));
    bytes.resize(random() % (bytes.size() + 1));
    static_cast<void>(connection->send_all(bytes, Milliseconds(100)));
    if (run % 20 == 0) {
      const int number = run / 20 + 1;
      ASSERT_EQ(link.deliver("kitchen-" + std::to_string(number), document("kitchen", number)).answer,
                HubAnswer::stored);
    }
  }
  end();
  EXPECT_FALSE(hub_->store().store()->is_damaged());
}

TEST_F(Inbox, ANewConnectionOfAStationReplacesItsLast) {
  HubLink stale = link_of("kitchen");
  ASSERT_EQ(stale.deliver("kitchen-1", document("kitchen", 1)).answer, HubAnswer::stored);
  HubLink fresh = link_of("kitchen");
  ASSERT_EQ(fresh.deliver("kitchen-2", document("kitchen", 2)).answer, HubAnswer::stored);
  std::this_thread::sleep_for(Milliseconds(50));
  stale.attend();
  EXPECT_FALSE(stale.is_connected());
  end();
  EXPECT_TRUE(hub_->inbox().stations().at("kitchen").is_connected);
}

TEST_F(Inbox, AConnectionKeepsItsName) {
  auto connection = connect_local(folder_.path() / "hub");
  ASSERT_TRUE(connection.ok());
  for (const char* hello :
       {R"({"station":"kitchen"})", R"({"station":"kitchen"})", R"({"station":"canteen"})"})
    ASSERT_TRUE(connection->send_all(encode({MessageType::hello, hello, {}}), Milliseconds(100)).ok());
  EXPECT_FALSE(connection->receive_some(Milliseconds(5000)).ok());
  end();
  EXPECT_FALSE(hub_->inbox().stations().at("kitchen").is_connected);
  EXPECT_FALSE(hub_->inbox().stations().contains("canteen"));
  EXPECT_NE(log_.find("said that it is canteen"), std::string::npos) << log_;
}

TEST_F(Inbox, ASecondHubIsRefused) {
  HubParams params;
  params.socket = folder_.path() / "hub";
  params.store.options.file = folder_.path() / "other.db";
  EXPECT_FALSE(Hub::start(params, [](const std::string&) {}).ok());
  params.socket = folder_.path() / "other";
  params.store.options.file = folder_.path() / "results.db";
  EXPECT_FALSE(Hub::start(params, [](const std::string&) {}).ok());
}

}  // namespace
}  // namespace traygauge::test
