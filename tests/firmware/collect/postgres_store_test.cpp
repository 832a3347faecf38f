// Events in a real PostgreSQL: each once, whatever is killed, and whoever else stores there.
#include "firmware/collect/postgres_store.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <thread>

#include "tests/firmware/collect/postgres_process.hpp"
#include "tests/firmware/collect/storm.hpp"
#include "tests/firmware/fleet/broker_process.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

CollectedEvent event(int number, const std::string& hub = "kitchen",
                     const std::string& taken_at = "2026-11-27T07:40:00.000Z") {
  const std::string id = "kitchen-" + std::to_string(number);
  return {hub, id, "scan", "kitchen", taken_at, R"({"id":")" + id + "\"}"};
}

std::unique_ptr<CollectedStore> open(const PostgresProcess& postgres) {
  StoreConfig config;
  config.database = postgres.address();
  auto store = PostgresStore::open(config);
  if (!store.ok()) throw std::runtime_error(store.failure());
  return std::move(*store);
}

TEST(PostgresStore, KeepsEachIdOnceAndTwinsBeside) {
  TRAYGAUGE_NEED_POSTGRES();
  const PostgresProcess postgres;
  auto store = open(postgres);
  auto batch = store->put(std::vector{event(1), event(2), event(1)}, 1'700'000'000'000);
  ASSERT_TRUE(batch.ok()) << batch.failure();
  EXPECT_EQ(batch->stored, 2U);
  EXPECT_EQ(batch->repeated, 1U);
  store.reset();
  store = open(postgres);
  const CollectedEvent other_time = event(2, "kitchen", "2026-11-28T07:40:00.000Z");
  batch = store->put(std::vector{event(1), other_time, event(1, "bar")}, 2);
  ASSERT_TRUE(batch.ok()) << batch.failure();
  EXPECT_EQ(batch->repeated, 1U);
  EXPECT_EQ(batch->twins, (std::vector<std::string>{"kitchen-2", "kitchen-1"}));
  batch = store->put(std::vector{other_time}, 3);
  EXPECT_EQ(batch->repeated, 1U) << "a twin that came again is no news";
  EXPECT_EQ(*store->count(), 2);
  EXPECT_EQ(postgres.value_of("SELECT received_ms FROM events WHERE id = 'kitchen-2'"), "1700000000000");
  EXPECT_EQ(postgres.value_of("SELECT body::jsonb ->> 'id' FROM events WHERE id = 'kitchen-1'"), "kitchen-1");
}

// What a foreign hub may call itself.
TEST(PostgresStore, TakesAnyTextOnce) {
  TRAYGAUGE_NEED_POSTGRES();
  const PostgresProcess postgres;
  auto store = open(postgres);
  const std::vector<std::string> texts = {
      "'; DROP TABLE events; --", "\"}", "{,}", "\\", "NULL", " ", "", "ü€😀", std::string("a\0b", 3),
      std::string(100'000, 'x')};
  std::vector<CollectedEvent> events;
  for (const std::string& text : texts) {
    CollectedEvent strange = event(static_cast<int>(events.size()));
    strange.id += text;
    strange.station = strange.hub = strange.taken_at = strange.body = text;
    strange.id.resize(std::min<std::size_t>(strange.id.size(), 200));  // as read_event() has it
    events.push_back(strange);
  }
  for (const std::size_t stored : {texts.size(), std::size_t{0}}) {
    const auto batch = store->put(events, 1);
    ASSERT_TRUE(batch.ok()) << batch.failure();
    EXPECT_EQ(batch->stored, stored);
    EXPECT_EQ(batch->repeated, texts.size() - stored);
    EXPECT_TRUE(batch->twins.empty());
  }
  EXPECT_EQ(postgres.value_of("SELECT body FROM events WHERE id LIKE 'kitchen-0%'"), texts[0]);
}

TEST(PostgresStore, GoesOnWhenTheServerComesBack) {
  TRAYGAUGE_NEED_POSTGRES();
  PostgresProcess postgres;
  auto store = open(postgres);
  ASSERT_TRUE(store->put(std::vector{event(1)}, 1).ok());
  postgres.end(SIGKILL);
  for (int i = 0; i < 2; ++i) {
    const auto refused = store->put(std::vector{event(2)}, 1);
    ASSERT_FALSE(refused.ok());
    EXPECT_TRUE(refused.failure().starts_with("postgresql://postgres@")) << refused.failure();
    EXPECT_EQ(refused.failure().find('\n'), std::string::npos);
  }
  postgres.start();
  const auto batch = store->put(std::vector{event(1), event(2)}, 1);
  ASSERT_TRUE(batch.ok()) << batch.failure();
  EXPECT_EQ(batch->stored, 1U);
  EXPECT_EQ(batch->repeated, 1U);
}

TEST(PostgresStore, SaysWhatIsWrongWithTheServerOrItsAddress) {
  TRAYGAUGE_NEED_POSTGRES();
  PostgresProcess postgres;
  const auto failure_of = [](const std::string& address) {
    StoreConfig config;
    config.database = address;
    const auto store = PostgresStore::open(config);
    return store.ok() ? std::string() : store.failure();
  };
  EXPECT_EQ(failure_of(postgres.address()), "");
  for (const char* secret :
       {"postgresql://me:geheim@db/x", "postgresql://me@db/x?password=geheim", "postgresql://[geheim"}) {
    const std::string failure = failure_of(secret);
    EXPECT_TRUE(failure.starts_with("store: expected ")) << failure;
    EXPECT_EQ(failure.find("geheim"), std::string::npos) << failure;
  }
  EXPECT_NE(failure_of("postgresql://me@/x?host=/nowhere").find("No such file"), std::string::npos);
  EXPECT_EQ(postgres.value_of("UPDATE traygauge_version SET version = 7 RETURNING version"), "7");
  EXPECT_NE(failure_of(postgres.address()).find("expected tables of version 1, found 7"), std::string::npos);
  postgres.end(SIGINT);
  postgres.start({"fsync=off"});
  EXPECT_NE(failure_of(postgres.address()).find("found fsync off"), std::string::npos);
}

// A server that answers before it wrote, as its owner chose for other programs.
TEST(PostgresStore, WaitsForTheDisk) {
  TRAYGAUGE_NEED_POSTGRES();
  PostgresProcess postgres;
  postgres.end(SIGINT);
  postgres.start({"synchronous_commit=off"});
  auto store = open(postgres);
  for (int number = 1; number <= 20; ++number) {
    ASSERT_TRUE(store->put(std::vector{event(number)}, 1).ok());
    postgres.end(SIGKILL);
    postgres.start({"synchronous_commit=off"});
    static_cast<void>(store->put({}, 1));  // finds the connection lost
    EXPECT_EQ(postgres.value_of("SELECT count(*) FROM events"), std::to_string(number));
    if (testing::Test::HasFailure()) break;
  }
}

TEST(PostgresStore, SeveralStoreTheSameAtOnce) {
  TRAYGAUGE_NEED_POSTGRES();
  const PostgresProcess postgres;
  constexpr int kEvents = 400;
  constexpr int kStores = 4;
  std::array<std::size_t, kStores> stored{};
  std::array<std::size_t, kStores> repeated{};
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < kStores; ++i) {
      threads.emplace_back([&, i] {
        const auto store = open(postgres);
        std::mt19937 random(static_cast<unsigned>(i));
        std::vector<CollectedEvent> events;
        for (int number = 0; number < kEvents; ++number) events.push_back(event(number));
        std::ranges::shuffle(events, random);
        for (std::size_t begin = 0; begin < events.size(); begin += 20) {
          const auto batch = store->put(std::span(events).subspan(begin, 20), 1);
          ASSERT_TRUE(batch.ok()) << batch.failure();
          stored[static_cast<std::size_t>(i)] += batch->stored;
          repeated[static_cast<std::size_t>(i)] += batch->repeated;
        }
      });
    }
  }
  EXPECT_EQ(stored[0] + stored[1] + stored[2] + stored[3], std::size_t{kEvents});
  EXPECT_EQ(repeated[0] + repeated[1] + repeated[2] + repeated[3], std::size_t{(kStores - 1) * kEvents});
  EXPECT_EQ(postgres.value_of("SELECT count(DISTINCT id) FROM events"), std::to_string(kEvents));
}

// Hubs, a broker, and two collectors of one database; one after the other is killed, and the database.
TEST(PostgresStorm, EverythingIsStoredOnceWhateverIsKilled) {
  TRAYGAUGE_NEED_POSTGRES();
  TRAYGAUGE_NEED_BROKER();
  constexpr int kHubs = 10;
  constexpr int kResults = 20;
  std::mt19937 random(random_seed());
  PostgresProcess postgres;
  BrokerProcess broker;
  const std::string lines =
      "host = \"127.0.0.1\"\ntls = false\nport = " + std::to_string(broker.port()) + "\n";
  CollectorProgram first(lines, "name = \"first\"\nstore = \"" + postgres.address() + "\"\n");
  CollectorProgram second(lines, "name = \"second\"\nstore = \"" + postgres.address() + "\"\n");
  BrokerConfig config;
  config.host = "127.0.0.1";
  config.port = broker.port();
  config.is_encrypted = false;
  Storm storm({config}, kHubs);
  for (int number = 1; number <= kResults; ++number) {
    storm.put_all(static_cast<std::uint64_t>(number));
    storm.step();
    const std::chrono::milliseconds pause(random() % 200);
    if (number % 8 == 2) storm.interrupt(first, pause);
    if (number % 8 == 4) storm.interrupt(second, pause);
    if (number % 8 == 6) {
      postgres.end(SIGKILL);
      storm.run_for(pause);
      postgres.start();
    }
  }
  EXPECT_TRUE(storm.drain(std::chrono::seconds(120))) << storm.waiting() << first.log() << second.log();
  EXPECT_EQ(first.stop(), 0) << first.log();
  EXPECT_EQ(second.stop(), 0) << second.log();
  EXPECT_EQ(postgres.value_of("SELECT count(*) FROM events"), std::to_string(kHubs * kResults));
  EXPECT_EQ(postgres.value_of("SELECT count(*) FROM twins"), "0");
}

}  // namespace
}  // namespace traygauge::test
