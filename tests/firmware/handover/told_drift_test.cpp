#include "firmware/handover/told_drift.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/firmware/handover/fake_hub.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

const std::vector<ToldTrend> kTrends = {
    {"scale_percent", 0.42, 0.05, 50, "In the last 50 trays … (± 0.05 %)."}, {"blur_px", 0.875, 0.0, 3, ""}};

TEST(ToldDrift, IsReadAsItWasTold) {
  for (const std::vector<ToldTrend>& told : {std::vector<ToldTrend>(), kTrends}) {
    const auto read = read_told_drift(told_drift_json(told));
    ASSERT_TRUE(read.ok()) << read.failure();
    EXPECT_EQ(*read, told);
  }
}

TEST(ToldDrift, WhatIsNoneIsRefused) {
  const std::string good = told_drift_json(kTrends);
  for (const char* const key : {"check", "median", "sigma", "scans", "drift"}) {
    nlohmann::json json = nlohmann::json::parse(good);
    json["trends"][1].erase(key);
    EXPECT_FALSE(read_told_drift(json.dump()).ok()) << key;
    json["trends"][1][key] = nullptr;
    EXPECT_FALSE(read_told_drift(json.dump()).ok()) << key;
  }
  for (const std::string text : {"", "[]", "{}", R"({"trends":{}})", R"({"trends":[1]})"})
    EXPECT_FALSE(read_told_drift(text).ok()) << text;
}

TEST(ToldDrift, IsAskedForByTheStationsName) {
  const TemporaryFolder folder;
  const FakeHub hub(folder.path() / "hub", [](const Message& message) -> std::vector<Message> {
    if (message.type != MessageType::ask_drift) return {};
    return {{MessageType::drift, told_drift_json(kTrends), {}}};
  });
  const auto told = ask_drift(folder.path() / "hub", "kitchen", Milliseconds(5000));
  ASSERT_TRUE(told.ok()) << told.failure();
  EXPECT_EQ(*told, kTrends);
  const std::vector<Message> asked = hub.received();
  ASSERT_EQ(asked.size(), 1U) << "a hello would take the running station's connection";
  EXPECT_EQ(nlohmann::json::parse(asked[0].text)["station"], "kitchen");
}

TEST(ToldDrift, AHubThatIsSilentOrGoneIsTold) {
  const TemporaryFolder folder;
  const auto failure = [&folder](const char* name) {
    const auto told = ask_drift(folder.path() / name, "kitchen", Milliseconds(100));
    return told.ok() ? std::string() : told.failure();
  };
  EXPECT_NE(failure("nothing").find("nobody answers there"), std::string::npos);
  const FakeHub silent(folder.path() / "silent", [](const Message&) { return std::vector<Message>(); });
  EXPECT_EQ(failure("silent"), "the hub did not answer within 100 ms");
  // As an earlier program does, which does not know the question.
  const FakeHub earlier(folder.path() / "earlier", [](const Message&) {
    return std::vector<Message>{{MessageType::drift, kHangUp, {}}};
  });
  EXPECT_NE(failure("earlier").find("the socket was closed"), std::string::npos) << failure("earlier");
  const FakeHub strange(folder.path() / "strange", [](const Message&) {
    return std::vector<Message>{{MessageType::drift, "[]", {}}};
  });
  EXPECT_EQ(failure("strange"), "expected an object with a list of trends");
}

}  // namespace
}  // namespace traygauge::test
