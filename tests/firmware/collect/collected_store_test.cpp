#include "firmware/collect/sqlite_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <span>

#include "tests/firmware/store/memory_folder.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

BrokerMessage message(const std::string& id, const std::string& taken_at = "2026-11-27T07:40:00.000Z",
                      const std::string& hub = "kitchen") {
  return {"traygauge/v1/" + hub + "/scan", R"({"event":"scan","id":")" + id +
                                               R"(","scan":{"station":"kitchen","taken_at":")" + taken_at +
                                               R"("}})"};
}

TEST(CollectedEvent, IsReadFromItsOwnTopicAlone) {
  const auto event = read_event("traygauge", message("kitchen-1"));
  ASSERT_TRUE(event);
  EXPECT_EQ(event->id, "kitchen-1");
  EXPECT_EQ(event->hub, "kitchen");
  EXPECT_EQ(event->station, "kitchen");
  EXPECT_EQ(event->body, message("kitchen-1").payload);
  const std::string good = message("kitchen-1").payload;
  for (const BrokerMessage& other : std::vector<BrokerMessage>{
           {"traygauge/v1/kitchen/correction", good},
           {"other/v1/kitchen/scan", good},
           {"traygauge/v1/kitchen/scan", ""},
           {"traygauge/v1/kitchen/scan", "[]"},
           {"traygauge/v1/kitchen/scan", R"({"event":"scan","id":7,"scan":{}})"},
           {"traygauge/v1/kitchen/scan", R"({"event":"scan","id":"","scan":{}})"},
           {"traygauge/v1/kitchen/scan", R"({"event":"scan","id":"kitchen-1","scan":[]})"},
           {"traygauge/v1/kitchen/scan",
            R"({"event":"scan","id":")" + std::string(300, 'x') + R"(","scan":{}})"},
           {"traygauge/v1/kitchen/scan", std::string(100'000, '[')},
           {"traygauge/v1/kitchen/scan", good.substr(0, good.size() - 1)}})
    EXPECT_FALSE(read_event("traygauge", other)) << other.topic << other.payload.substr(0, 80);
}

TEST(SqliteStore, KeepsEachIdOnceAndTwinsBeside) {
  const MemoryFolder folder;
  const auto events = [](std::initializer_list<BrokerMessage> messages) {
    std::vector<CollectedEvent> read;
    for (const BrokerMessage& each : messages) read.push_back(*read_event("traygauge", each));
    return read;
  };
  {
    auto store = SqliteStore::open(folder.path() / "r.db");
    ASSERT_TRUE(store.ok()) << store.failure();
    const auto batch =
        (*store)->put(events({message("kitchen-1"), message("kitchen-2"), message("kitchen-1")}), 1);
    ASSERT_TRUE(batch.ok()) << batch.failure();
    EXPECT_EQ(batch->stored, 2U);
    EXPECT_EQ(batch->repeated, 1U);
    EXPECT_FALSE(SqliteStore::open(folder.path() / "r.db").ok()) << "another program has it";
  }
  auto store = SqliteStore::open(folder.path() / "r.db");
  ASSERT_TRUE(store.ok()) << store.failure();
  const auto other_time = message("kitchen-2", "2026-11-28T07:40:00.000Z");
  const auto other_hub = message("kitchen-1", "2026-11-27T07:40:00.000Z", "bar");
  auto batch = (*store)->put(events({message("kitchen-1"), other_time, other_hub}), 2);
  ASSERT_TRUE(batch.ok()) << batch.failure();
  EXPECT_EQ(batch->repeated, 1U);
  EXPECT_EQ(batch->twins, (std::vector<std::string>{"kitchen-2", "kitchen-1"}));
  batch = (*store)->put(events({other_time}), 3);
  EXPECT_EQ(batch->repeated, 1U) << "a twin that came again is no news";
  EXPECT_EQ(*(*store)->count(), 2);
}

// As brokers deliver after a failure: in any order, some of them several times, and the collector is started
// again in between.
TEST(SqliteStore, TakesEventsInAnyOrderAnyNumberOfTimes) {
  const MemoryFolder folder;
  std::mt19937 random(random_seed());
  constexpr std::size_t kEvents = 300;
  std::vector<CollectedEvent> deliveries;
  for (std::size_t i = 0; i < kEvents; ++i) {
    const auto event = read_event("traygauge", message("kitchen-" + std::to_string(i)));
    deliveries.insert(deliveries.end(), 1 + random() % 4, *event);
  }
  std::shuffle(deliveries.begin(), deliveries.end(), random);
  StoredBatch sum;
  std::span<const CollectedEvent> left = deliveries;
  while (!left.empty()) {
    auto store = SqliteStore::open(folder.path() / "r.db");
    ASSERT_TRUE(store.ok()) << store.failure();
    for (int batches = 0; batches < 10 && !left.empty(); ++batches) {
      const std::size_t count = std::min<std::size_t>(left.size(), 1 + random() % 32);
      const auto batch = (*store)->put(left.first(count), 1);
      ASSERT_TRUE(batch.ok()) << batch.failure();
      sum.stored += batch->stored;
      sum.repeated += batch->repeated;
      EXPECT_TRUE(batch->twins.empty());
      left = left.subspan(count);
    }
  }
  EXPECT_EQ(sum.stored, kEvents);
  EXPECT_EQ(sum.repeated, deliveries.size() - kEvents);
  auto store = SqliteStore::open(folder.path() / "r.db");
  ASSERT_TRUE(store.ok()) << store.failure();
  EXPECT_EQ(*(*store)->count(), std::int64_t{kEvents});
}

}  // namespace
}  // namespace traygauge::test
