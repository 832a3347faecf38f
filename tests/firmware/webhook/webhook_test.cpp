#include "firmware/webhook/webhook.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "firmware/api/scan_answer.hpp"
#include "firmware/webhook/signature.hpp"
#include "tests/firmware/webhook/receiver.hpp"
#include "tests/firmware/webhook/webhook_rig.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::ordered_json;
using std::chrono::milliseconds;
using Ids = std::vector<std::string>;

Reply take(const ReceivedMessage& /*message*/) {
  return Reply::status(204);
}

// The scans 1 to `last`.
Ids ids_up_to(int last) {
  Ids ids;
  for (int number = 1; number <= last; ++number) ids.push_back("kitchen-" + std::to_string(number));
  return ids;
}

TEST(Webhook, TellsEachScanAndCorrectionOnceInOrder) {
  Receiver receiver(take);
  WebhookRig rig(receiver.url());
  rig.put(1);
  rig.put(2);
  rig.correct(1, "bulgur");
  rig.put(3);
  ASSERT_TRUE(rig.run_until([&] { return rig.state().delivered == 4; }));
  EXPECT_EQ(rig.waiting(), 0);
  rig.restart();
  rig.run_for(milliseconds(30));
  const std::vector<ReceivedMessage> received = receiver.received();
  ASSERT_EQ(received.size(), 4U);
  EXPECT_EQ(receiver.event_ids(),
            (Ids{"kitchen-1", "kitchen-2", "kitchen-1.correction-1.1795765200000", "kitchen-3"}));
  const auto scan = rig.store().scans().find({"kitchen", 1});
  const Expected<Json> answer = scan_answer(rig.store(), **scan);
  ASSERT_TRUE(answer.ok());
  const Json expected = {
      {"event", "correction"}, {"id", "kitchen-1.correction-1.1795765200000"}, {"scan", *answer}};
  EXPECT_EQ(received[2].body, expected.dump());
  EXPECT_EQ(Json::parse(received[0].body).at("event"), "scan");
  EXPECT_EQ(received[0].head.substr(0, received[0].head.find("\r\n")), "POST /scans?key=hidden HTTP/1.1");
  EXPECT_EQ(received[0].header("Content-Type"), "application/json");
  EXPECT_EQ(received[0].header("Traygauge-Signature"), "");
  EXPECT_TRUE(rig.log().empty()) << rig.log().front();
}

TEST(Webhook, KeepsTheOrderWhileTheReceiverFails) {
  int messages = 0;
  Receiver receiver(
      [&](const ReceivedMessage& message) { return ++messages <= 3 ? Reply::status(500) : take(message); });
  WebhookRig rig(receiver.url());
  rig.put(1);
  rig.put(2);
  ASSERT_TRUE(rig.run_until([&] { return rig.state().delivered == 2; }));
  EXPECT_EQ(receiver.event_ids(), (Ids{"kitchen-1", "kitchen-1", "kitchen-1", "kitchen-1", "kitchen-2"}));
  EXPECT_EQ(rig.state().failed_attempts, 3U);
  ASSERT_EQ(rig.log().size(), 2U) << "the failure once, and its end";
  EXPECT_NE(rig.log()[0].find("answered 500."), std::string::npos) << rig.log()[0];
  EXPECT_NE(rig.log()[1].find("again"), std::string::npos) << rig.log()[1];
  EXPECT_EQ(rig.state().last_failure, "");
  EXPECT_FALSE(rig.state().waiting_since);
}

TEST(Webhook, TellsAgainWhatWasToldJustBeforeAKill) {
  std::atomic<bool> has_come{false};
  Receiver receiver([&](const ReceivedMessage& message) {
    if (!has_come.exchange(true)) std::this_thread::sleep_for(milliseconds(50));
    return take(message);
  });
  WebhookRig rig(receiver.url());
  rig.put(1);
  ASSERT_TRUE(rig.run_until([&] { return has_come.load(); }));
  rig.restart();
  ASSERT_TRUE(rig.run_until([&] { return rig.state().delivered == 1; }));
  EXPECT_EQ(receiver.event_ids(), (Ids{"kitchen-1", "kitchen-1"}));
  EXPECT_EQ(receiver.received()[0].body, receiver.received()[1].body);
}

TEST(Webhook, AFullStoreDrainsInOrder) {
  constexpr int kScans = 500;
  Receiver receiver(take);
  WebhookRig rig(receiver.url());
  for (int number = 1; number <= kScans; ++number) rig.put(static_cast<std::uint64_t>(number));
  EXPECT_EQ(rig.waiting(), kScans);
  const DiskCounters before = rig.store().disk();
  ASSERT_TRUE(rig.run_until([&] { return rig.waiting() == 0; }, milliseconds(20000)));
  EXPECT_EQ(receiver.event_ids(), ids_up_to(kScans));
  // Sixteen are noted in one go.
  EXPECT_LE(rig.store().disk().syncs - before.syncs, 4U * (kScans / 16 + 1));
}

TEST(Webhook, SignsWithTheTimeAndTheSecret) {
  const std::string secret = "a-secret-of-some-characters";
  MemoryFolder folder;
  Receiver receiver(take);
  WebhookRig rig(receiver.url());
  WebhookConfig config = rig.config();
  config.secret = folder.path() / "secret";
  {
    std::FILE* const file = std::fopen(config.secret->c_str(), "w");
    ASSERT_NE(file, nullptr);
    std::fputs((secret + "\n").c_str(), file);
    std::fclose(file);
    std::filesystem::permissions(*config.secret, std::filesystem::perms::owner_read);
  }
  rig.restart(config);
  rig.put(1);
  const std::int64_t before_s = read_wall_clock().unix_ms / 1000;
  ASSERT_TRUE(rig.run_until([&] { return rig.state().delivered == 1; }));
  const ReceivedMessage message = receiver.received().front();
  const std::string signature = message.header("Traygauge-Signature");
  ASSERT_EQ(signature.rfind("t=", 0), 0U) << signature;
  const std::string time = signature.substr(2, signature.find(',') - 2);
  EXPECT_GE(std::stoll(time), before_s);
  EXPECT_LE(std::stoll(time), read_wall_clock().unix_ms / 1000);
  EXPECT_EQ(signature.substr(signature.find(',')),
            ",v1=" + hmac_sha256_hex(secret, time + "." + message.body));
}

TEST(Webhook, ARefusalIsSaidOnceAndTriedAtTheSlowestPace) {
  for (const int status : {400, 404, 410, 422}) {
    Receiver receiver([&](const ReceivedMessage&) { return Reply::status(status); });
    WebhookRig rig(receiver.url());
    rig.put(1);
    ASSERT_TRUE(rig.run_until([&] { return rig.state().failed_attempts == 1; })) << status;
    EXPECT_TRUE(rig.state().is_refused) << status;
    const auto refused_at = std::chrono::steady_clock::now();
    ASSERT_TRUE(rig.run_until([&] { return rig.state().failed_attempts == 2; })) << status;
    EXPECT_GE(std::chrono::steady_clock::now() - refused_at, quick_limits().longest_wait * 3 / 4) << status;
    ASSERT_EQ(rig.log().size(), 1U) << status;
    EXPECT_NE(rig.log()[0].find("answered " + std::to_string(status)), std::string::npos) << rig.log()[0];
    receiver.behave(take);
    ASSERT_TRUE(rig.run_until([&] { return rig.state().delivered == 1; })) << status;
    EXPECT_FALSE(rig.state().is_refused);
  }
  for (const int status : {302, 408, 425, 429, 500, 503}) {
    Receiver receiver([&](const ReceivedMessage&) { return Reply::status(status); });
    WebhookRig rig(receiver.url());
    rig.put(1);
    ASSERT_TRUE(rig.run_until([&] { return rig.state().failed_attempts == 3; })) << status;
    EXPECT_FALSE(rig.state().is_refused) << status;
  }
}

TEST(Webhook, NeverHoldsTheLoopWhileTheReceiverHangs) {
  Receiver receiver([](const ReceivedMessage&) { return Reply{}; });
  WebhookRig rig(receiver.url());
  rig.put(1);
  ASSERT_TRUE(rig.run_until([&] { return rig.state().failed_attempts == 2; }));
  EXPECT_LT(rig.longest_call(), milliseconds(50));
  std::cout << "longest call: " << rig.longest_call().count() << " us" << std::endl;
  EXPECT_EQ(rig.state().last_failure, "http://127.0.0.1:" + std::to_string(receiver.port()) +
                                          " took the message and did not answer in time.");
}

TEST(Webhook, AStoreThatWasReplacedKeepsItsOwn) {
  Receiver receiver(take);
  WebhookRig rig(receiver.url());
  for (std::uint64_t number = 1; number <= 3; ++number) rig.put(number);
  ASSERT_TRUE(rig.run_until([&] { return rig.state().delivered == 1; }));
  // Damaged in the middle of a round: a new store takes its place, and its places begin anew.
  const std::filesystem::path file = rig.store().database().file();
  rig.store().database().note_damage("for a test");
  std::filesystem::remove(file);
  for (const std::string& sentence : rig.hub_store().tend(std::chrono::steady_clock::now())) {
    EXPECT_NE(sentence.find("told"), std::string::npos) << sentence;
  }
  ASSERT_NE(rig.hub_store().store(), nullptr);
  for (std::uint64_t number = 11; number <= 13; ++number) rig.put(number);
  ASSERT_TRUE(rig.run_until([&] { return rig.waiting() == 0 && rig.state().delivered >= 4; }));
  const Ids ids = receiver.event_ids();
  ASSERT_GE(ids.size(), 4U);
  EXPECT_EQ((Ids{ids.end() - 3, ids.end()}), (Ids{"kitchen-11", "kitchen-12", "kitchen-13"}));
}

// Whatever the receiver does and whenever the hub is killed: every event arrives, the first times in order.
TEST(Webhook, EveryEventArrivesAtLeastOnceAndInOrder) {
  std::mt19937 random(random_seed());
  std::mt19937 chance(random());
  Ids taken;
  const auto behave = [&](const ReceivedMessage& message) -> Reply {
    const auto what = chance() % 12;
    if (what == 0) return Reply::status(503);
    if (what == 1) return Reply::status(429);
    if (what == 2) return {"", true};
    if (what == 3) return {"rubbish\r\n\r\n", true};
    if (what == 4) return Reply::status(301, "Location: http://127.0.0.1:1/\r\n");
    if (what == 5 && chance() % 4 == 0) return {};  // hangs
    if (what == 6) return {"HTTP/1.1 200 OK\r\nContent-Le", true};
    taken.push_back(message.event_id());
    if (what == 7) return {"HTTP/1.1 200 OK\r\n\r\nok", true};
    if (what == 8) return {"HTTP/1.1 200 OK\r\n\r\n" + std::string(100'000, 'x'), true};
    return Reply::status(200);
  };
  Receiver receiver(behave);
  WebhookLimits limits = quick_limits();
  limits.answer_within = milliseconds(60);
  limits.longest_wait = milliseconds(16);
  WebhookRig rig(receiver.url(), limits);
  Ids happened;
  std::uint64_t last = 0;
  std::map<std::uint64_t, int> corrections;
  for (int round = 0; round < 120; ++round) {
    for (auto i = random() % 3; i > 0; --i) {
      rig.put(++last);
      happened.push_back("kitchen-" + std::to_string(last));
    }
    if (last > 0 && random() % 3 == 0) {
      const std::uint64_t number = 1 + random() % last;
      rig.correct(number, "food " + std::to_string(round));
      happened.push_back("kitchen-" + std::to_string(number) + ".correction-" +
                         std::to_string(++corrections[number]) + ".1795765200000");
    }
    for (auto i = random() % 8; i > 0; --i) rig.step(milliseconds(random() % 3));
    if (random() % 10 == 0) rig.restart();
  }
  ASSERT_TRUE(rig.run_until([&] { return rig.waiting() == 0; }, milliseconds(20000)))
      << rig.state().last_failure;
  receiver.behave(take);  // which waits for the receiver's thread
  Ids first_times;
  for (const std::string& id : taken) {
    if (std::find(first_times.begin(), first_times.end(), id) == first_times.end()) first_times.push_back(id);
  }
  EXPECT_EQ(first_times, happened);
  EXPECT_LT(rig.longest_call(), milliseconds(50));
  std::cout << happened.size() << " events, told " << taken.size() << " times, longest call "
            << rig.longest_call().count() << " us" << std::endl;
}

}  // namespace
}  // namespace traygauge::test
