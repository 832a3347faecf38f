#include "firmware/handover/hub_link.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/firmware/handover/fake_hub.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

std::string document(const std::string& id) {
  return R"({"id":")" + id + R"("})";
}

Message reply(MessageType type, const std::string& id, const std::string& why = {}) {
  return {type, R"({"id":")" + id + R"(","why":")" + why + R"("})", {}};
}

class HubLinkTest : public ::testing::Test {
 protected:
  HubLinkParams params() const {
    HubLinkParams params;
    params.socket = folder_.path() / "hub";
    params.station = "kitchen";
    params.program_version = "1.2.3";
    params.answer_timeout = Milliseconds(300);
    params.retry_after = Milliseconds(0);
    return params;
  }
  std::filesystem::path socket() const { return params().socket; }

  TemporaryFolder folder_;
};

TEST_F(HubLinkTest, HandsOverAndIsTold) {
  const FakeHub hub(socket(), store_all);
  HubLink link(params());
  for (int i = 1; i <= 20; ++i) {
    const std::string id = "kitchen-" + std::to_string(i);
    EXPECT_EQ(link.deliver(id, document(id)).answer, HubAnswer::stored);
  }
  const auto hellos = hub.received(MessageType::hello);
  ASSERT_EQ(hellos.size(), 1U);
  EXPECT_NE(hellos[0].text.find("kitchen"), std::string::npos);
  EXPECT_EQ(hub.received(MessageType::scan).size(), 20U);
}

TEST_F(HubLinkTest, PassesOnWhyAScanIsNotStored) {
  const FakeHub hub(socket(), [](const Message& message) -> std::vector<Message> {
    if (message.type != MessageType::scan) return {};
    const bool is_first = message.text == document("kitchen-1");
    return {is_first ? reply(MessageType::refused, "kitchen-1", "the disk is full")
                     : reply(MessageType::set_aside, "kitchen-2", "no such station")};
  });
  HubLink link(params());
  const HubReply refused = link.deliver("kitchen-1", document("kitchen-1"));
  EXPECT_EQ(refused.answer, HubAnswer::refused);
  EXPECT_EQ(refused.text, "the disk is full");
  EXPECT_FALSE(refused.is_kept_there());
  const HubReply aside = link.deliver("kitchen-2", document("kitchen-2"));
  EXPECT_EQ(aside.answer, HubAnswer::set_aside);
  EXPECT_TRUE(aside.is_kept_there());
}

TEST_F(HubLinkTest, TakesNoAnswerForAnother) {
  const FakeHub hub(socket(), [](const Message& message) -> std::vector<Message> {
    if (message.type != MessageType::scan) return {};
    return {reply(MessageType::stored, "kitchen-1"),
            {MessageType::stored, "no json", {}},
            {MessageType::stored, "{\"id\":7}", {}}};
  });
  HubLink link(params());
  EXPECT_EQ(link.deliver("kitchen-2", document("kitchen-2")).answer, HubAnswer::absent);
}

TEST_F(HubLinkTest, EndsWithinItsTimeWhateverTheHubDoes) {
  for (const std::string behaviour : {"absent", "silent", "hangs up", "talks nonsense", "chatters"}) {
    std::optional<FakeHub> hub;
    if (behaviour != "absent")
      hub.emplace(socket(), [&behaviour](const Message& message) -> std::vector<Message> {
        if (message.type != MessageType::scan || behaviour == "silent") return {};
        if (behaviour == "hangs up") return {{MessageType::stored, kHangUp, {}}};
        if (behaviour == "talks nonsense") return {{MessageType::hello, "?", {}}};
        return std::vector<Message>(100, {MessageType::state, "{}", {}});
      });
    HubLink link(params());
    const auto begin = std::chrono::steady_clock::now();
    const HubReply answer = link.deliver("kitchen-1", document("kitchen-1"));
    EXPECT_EQ(answer.answer, HubAnswer::absent) << behaviour;
    EXPECT_FALSE(answer.text.empty()) << behaviour;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, Milliseconds(2000)) << behaviour;
  }
}

TEST_F(HubLinkTest, FindsAHubThatCameBack) {
  HubLink link(params());
  EXPECT_EQ(link.deliver("kitchen-1", document("kitchen-1")).answer, HubAnswer::absent);
  {
    const FakeHub hub(socket(), store_all);
    EXPECT_EQ(link.deliver("kitchen-1", document("kitchen-1")).answer, HubAnswer::stored);
    EXPECT_TRUE(link.take_is_new());
    EXPECT_FALSE(link.take_is_new());
  }
  EXPECT_EQ(link.deliver("kitchen-2", document("kitchen-2")).answer, HubAnswer::absent);
  const FakeHub hub(socket(), store_all);
  EXPECT_EQ(link.deliver("kitchen-2", document("kitchen-2")).answer, HubAnswer::stored);
  EXPECT_TRUE(link.take_is_new());
}

TEST_F(HubLinkTest, DoesNotKnockWithoutAPause) {
  HubLinkParams patient = params();
  patient.retry_after = Milliseconds(60000);
  HubLink link(patient);
  EXPECT_EQ(link.deliver("kitchen-1", document("kitchen-1")).answer, HubAnswer::absent);
  const FakeHub hub(socket(), store_all);
  EXPECT_EQ(link.deliver("kitchen-1", document("kitchen-1")).answer, HubAnswer::absent);
  EXPECT_FALSE(link.is_connected());
}

}  // namespace
}  // namespace traygauge::test
