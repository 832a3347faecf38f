// The webhook as part of a hub: what its log, /health and /metrics say.
#include <gtest/gtest.h>

#include <filesystem>

#include "firmware/hub/hub.hpp"
#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/firmware/webhook/hub_answer.hpp"
#include "tests/firmware/webhook/receiver.hpp"
#include "tests/firmware/webhook/webhook_rig.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;

class WebhookHubTest : public testing::Test {
 protected:
  void start(const std::optional<std::string>& url) {
    hub_.reset();
    log_.clear();
    HubParams params;
    params.socket = folder_.path() / "hub";
    params.store.options.file = folder_.path() / "results.db";
    params.web.config.listen = {"127.0.0.1:0"};
    if (url) params.webhook = WebhookConfig{*url, {}, {}};
    params.webhook_limits = quick_limits();
    params.webhook_limits.patience = milliseconds(100);
    auto hub = Hub::start(params, [this](const std::string& sentence) { log_ += sentence + "\n"; });
    ASSERT_TRUE(hub.ok()) << hub.failure();
    hub_ = std::move(*hub);
  }
  void put(std::uint64_t number) {
    ASSERT_TRUE(hub_->store().store()->scans().put(sample_document(number), at(kMorningMs)).ok());
  }
  // False where it does not become true in time.
  bool run_until(const std::function<bool()>& is_done, milliseconds limit = milliseconds(5000)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!is_done()) {
      if (std::chrono::steady_clock::now() >= end) return false;
      hub_->step(milliseconds(5));
    }
    return true;
  }
  void run_for(milliseconds time) {
    run_until([] { return false; }, time);
  }
  std::string get(const std::string& target) { return answer_of(*hub_, target); }
  bool logged(const std::string& text) const { return log_.find(text) != std::string::npos; }

  MemoryFolder folder_;
  std::unique_ptr<Hub> hub_;
  std::string log_;
};

TEST_F(WebhookHubTest, TellsNothingOfThePastAndForgetsWhatWaitsWhereTheKeyIsGone) {
  Receiver receiver([](const ReceivedMessage&) { return Reply::status(200); });
  const auto told = [&] { return receiver.event_ids().size(); };
  start(std::nullopt);
  put(1);
  run_for(milliseconds(20));
  EXPECT_EQ(log_, "");
  start(receiver.url());
  EXPECT_TRUE(logged("it is not told of earlier ones")) << log_;
  put(2);
  EXPECT_TRUE(run_until([&] { return told() == 1; }));
  run_for(milliseconds(20));
  EXPECT_EQ(receiver.event_ids(), std::vector<std::string>{"kitchen-2"});
  receiver.behave([](const ReceivedMessage&) { return Reply::status(500); });
  put(3);
  EXPECT_TRUE(run_until([&] { return told() == 3; }));
  start(receiver.url());
  EXPECT_EQ(log_, "") << "it is not new any more";
  start(std::nullopt);
  EXPECT_TRUE(logged("1 scans and corrections that waited for it will not be told")) << log_;
  EXPECT_EQ(get("/health").find("webhook"), std::string::npos);
  receiver.behave([](const ReceivedMessage&) { return Reply::status(200); });
  start(receiver.url());
  put(4);
  const std::size_t before = told();
  EXPECT_TRUE(run_until([&] { return told() > before; }));
  EXPECT_EQ(receiver.event_ids().back(), "kitchen-4");
}

TEST_F(WebhookHubTest, HealthWarnsAndFiguresCount) {
  Receiver receiver([](const ReceivedMessage&) { return Reply::status(500); });
  const auto answers = [this](const std::string& target, const std::string& text) {
    return run_until([&] { return get(target).find(text) != std::string::npos; });
  };
  constexpr const char* kWell = R"({"name":"webhook","status":"ok","message":null})";
  start(receiver.url());
  EXPECT_TRUE(answers("/health", kWell));
  put(1);
  put(2);
  const std::string shown = "http://127.0.0.1:" + std::to_string(receiver.port());
  EXPECT_TRUE(answers(
      "/health",
      R"({"name":"webhook","status":"warning","message":"Scans and corrections wait to be told: 2. )" +
          shown + R"( answered 500."})"))
      << get("/health");
  EXPECT_EQ(get("/health").find("hidden"), std::string::npos) << "the query may hold a secret";
  EXPECT_FALSE(logged("hidden")) << log_;
  EXPECT_TRUE(answers("/metrics", "traygauge_webhook_waiting 2\n"));
  EXPECT_EQ(get("/metrics").find("traygauge_webhook_failed_attempts_total 0\n"), std::string::npos);
  receiver.behave([](const ReceivedMessage&) { return Reply::status(200); });
  EXPECT_TRUE(answers("/metrics", "traygauge_webhook_delivered_total 2\n")) << get("/metrics");
  EXPECT_TRUE(answers("/metrics", "traygauge_webhook_waiting 0\n"));
  EXPECT_TRUE(answers("/health", kWell));
}

TEST_F(WebhookHubTest, ARefusalIsAWarningAtOnce) {
  Receiver receiver([](const ReceivedMessage&) { return Reply::status(410); });
  start(receiver.url());
  put(1);
  EXPECT_TRUE(run_until([this] {
    return get("/health").find("answered 410: nobody is there any more.") != std::string::npos;
  }));
}

TEST_F(WebhookHubTest, SaysOnceThatTheWayIsNotEncrypted) {
  start("http://192.0.2.1/scans?key=hidden");
  EXPECT_TRUE(logged("The webhook http://192.0.2.1 is not encrypted")) << log_;
  start("http://localhost/scans");
  EXPECT_FALSE(logged("not encrypted")) << log_;
  start("https://192.0.2.1/scans");
  EXPECT_FALSE(logged("not encrypted")) << log_;
}

}  // namespace
}  // namespace traygauge::test
