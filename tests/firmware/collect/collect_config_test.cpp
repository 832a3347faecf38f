#include "firmware/collect/collect_config.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "firmware/collect/collector.hpp"
#include "simulator/capture/input_error.hpp"
#include "tests/firmware/store/memory_folder.hpp"

namespace traygauge::test {
namespace {

class CollectConfigTest : public testing::Test {
 protected:
  std::string error_of(const std::string& lines) {
    const std::filesystem::path file = folder_.path() / "collector.toml";
    std::ofstream(file) << lines;
    try {
      const auto started = Collector::start(read_collect_config(file));
      return started.ok() ? "none" : started.failure();
    } catch (const InputError& error) {
      return error.what();
    }
  }
  void expect(const std::string& lines, std::initializer_list<const char*> parts) {
    const std::string error = error_of(lines);
    for (const char* const part : parts)
      EXPECT_NE(error.find(part), std::string::npos) << part << "\n" << error;
    EXPECT_EQ(error.find("fleet"), std::string::npos) << error;
  }
  MemoryFolder folder_;
};

TEST_F(CollectConfigTest, TheShippedOneIsRead) {
  const CollectConfig config =
      read_collect_config(std::filesystem::path(TRAYGAUGE_SOURCE_DIR) / "config" / "collector.toml");
  EXPECT_EQ(config.broker.shown(), "mqtts://broker.example:8883");
  EXPECT_EQ(config.broker.prefix, "traygauge");
  EXPECT_EQ(config.name, "collector");
}

TEST_F(CollectConfigTest, ErrorsNameFileKeyExpectedAndFound) {
  const std::string broker = "[broker]\nhost = \"b\"\n";
  EXPECT_EQ(error_of("store = \"r.db\"\n" + broker), "none");
  expect(broker, {"collector.toml", "store"});
  expect("store = \"r.db\"\n", {"collector.toml", "broker"});
  expect("version = 2\nstore = \"r.db\"\n" + broker, {"version", "found 2"});
  expect("name = \"A b\"\nstore = \"r.db\"\n" + broker, {"name", "1 to 32 of a-z"});
  expect("store = \"r.db\"\nstore_password_file = \"p\"\n" + broker,
         {"store_password_file", "beside a file of SQLite"});
  expect("store = \"postgresql://a@b/c\"\nstore_password_file = \"absent\"\n" + broker,
         {"store_password_file: ", "absent"});
  expect("store = \"postgresql://a:b@c/d\"\n" + broker, {"store: ", "without a password"});
  expect("stores = \"r.db\"\n" + broker, {"stores"});
  expect("store = \"r.db\"\n" + broker + "hosts = 1\n", {"broker.hosts"});
  expect("store = \"r.db\"\n" + broker + "port = 70000\n", {"broker.port", "1 to 65535"});
  expect("store = \"r.db\"\n" + broker + "ca = \"absent\"\n",
         {"broker.ca: ", "expected certificates in PEM"});
  expect("store = \"no/folder/r.db\"\n" + broker, {"store: ", "Check that the folder exists"});
  std::ofstream(folder_.path() / "other.db")
      << "no database at all, but long enough to be looked at as one ...";
  expect("store = \"other.db\"\n" + broker, {"store: ", "other.db"});
}

}  // namespace
}  // namespace traygauge::test
