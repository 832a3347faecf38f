#include "firmware/store/schema.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <span>

#include "tests/firmware/store/open_sample.hpp"

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

// As the sqlite3 program does.
void restore(const fs::path& dump, const fs::path& file) {
  std::ifstream stream(dump);
  ASSERT_TRUE(stream) << dump;
  const std::string sql{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &handle), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(handle);
  sqlite3_close(handle);
}

fs::path frozen(std::size_t version) {
  return fs::path(TRAYGAUGE_SOURCE_DIR) / "tests/firmware/store/frozen" /
         ("version_" + std::to_string(version) + ".sql");
}

// By the program of the first version.
std::string first_document() {
  SampleScan scan;
  scan.taken_ms = kMorningMs + 60'000;
  scan.has_checks = false;
  return sample_document(scan);
}

// Each version's store was frozen with the same content: see frozen/README.md.
void expect_frozen_content(Store& store) {
  EXPECT_EQ(store.scans().totals()->counts.scans, 3);
  const auto superseded = store.scans().find({"kitchen", 1});
  ASSERT_TRUE(superseded.ok() && *superseded);
  EXPECT_EQ((*superseded)->superseded_by, (ScanId{"kitchen", 2}));
  EXPECT_EQ((*superseded)->document, first_document());
  const auto corrected = store.corrections().corrected({"kitchen", 2});
  ASSERT_TRUE(corrected.ok() && *corrected);
  EXPECT_EQ((*corrected)->items.size(), 5U);
  EXPECT_EQ((*corrected)->items[0].food, "bulgur");
  EXPECT_EQ((*corrected)->items[1].split_from, 2);
  HistoryFilter filter;
  filter.food = "bulgur";
  EXPECT_EQ(store.history().page(filter, 10)->scans.size(), 1U);
  // Version 1 told scans alone.
  const auto due = store.deliveries().due("webhook", kMorningMs + 60'000, 10);
  EXPECT_EQ(std::count_if(due->begin(), due->end(),
                          [](const PendingDelivery& delivery) { return delivery.correction == 0; }),
            2);
  const auto aside = store.scans().set_aside_documents(0, 10);
  ASSERT_EQ(aside->size(), 1U);
  EXPECT_EQ(aside->front().document, "no document");
}

void fill_for_freezing(Store& store) {
  ASSERT_TRUE(store.scans().put(first_document(), at(kMorningMs)).ok());
  SampleScan second;
  second.id.number = 2;
  second.supersedes = ScanId{"kitchen", 1};
  ASSERT_TRUE(store.scans().put(sample_document(second), at(kMorningMs)).ok());
  ASSERT_TRUE(store.scans().put(sample_document(3), at(kMorningMs)).ok());
  ASSERT_TRUE(store.scans().put("no document", at(kMorningMs)).ok());
  const ScanId id{"kitchen", 2};
  CorrectionBook& book = store.corrections();
  ASSERT_TRUE(book.add(id, RenameItem{2, "bulgur"}, "chef", "tasted", at(kMorningMs)).ok());
  ASSERT_TRUE(book.add(id, SplitItem{2, 20.0, "corn"}, "chef", "", at(kMorningMs)).ok());
  ASSERT_TRUE(store.deliveries().mark_delivered("webhook", std::array<DeliveryKey, 1>{{{1}}}).ok());
  ASSERT_TRUE(
      store.deliveries().mark_failed("webhook", {2}, kMorningMs, std::chrono::seconds(30), "refused").ok());
}

class SchemaTest : public testing::Test {
 protected:
  SchemaTest() {
    options_.file = folder_.path() / "results.db";
    options_.destinations = {"webhook"};
  }
  MemoryFolder folder_;
  StoreOptions options_;
};

TEST_F(SchemaTest, OpensAStoreOfEveryOlderVersion) {
  for (std::size_t version = 1; version <= schema_steps().size(); ++version) {
    options_.file = folder_.path() / ("version_" + std::to_string(version) + ".db");
    restore(frozen(version), options_.file);
    const std::unique_ptr<Store> store = open_or_fail(options_);
    ASSERT_NE(store, nullptr) << version;
    expect_frozen_content(*store);
    EXPECT_EQ(*store->database().integer("test", "PRAGMA user_version"),
              static_cast<std::int64_t>(schema_steps().size()));
  }
}

// TRAYGAUGE_KEEP_STORE=FILE keeps it there, to be frozen.
TEST_F(SchemaTest, ANewStoreHasWhatAFrozenOneHas) {
  if (const char* const kept = std::getenv("TRAYGAUGE_KEEP_STORE")) options_.file = kept;
  const std::unique_ptr<Store> store = open_or_fail(options_);
  ASSERT_NE(store, nullptr);
  fill_for_freezing(*store);
  expect_frozen_content(*store);
  EXPECT_EQ(*store->database().integer("test", "PRAGMA application_id"), kStoreApplicationId);
}

TEST_F(SchemaTest, ANewerStoreIsRefusedAndLeft) {
  open_or_fail(options_);
  const auto version = [&](const char* sql) {
    sqlite3* handle = nullptr;
    EXPECT_EQ(sqlite3_open(options_.file.c_str(), &handle), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(handle, sql, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(handle);
  };
  version("PRAGMA user_version = 1000");
  const Expected<OpenedStore> opened = open_store(options_, at(kMorningMs));
  ASSERT_FALSE(opened.ok());
  EXPECT_NE(opened.failure().find("the store has version 1000"), std::string::npos) << opened.failure();
  version(("PRAGMA user_version = " + std::to_string(schema_steps().size())).c_str());
  EXPECT_NE(open_or_fail(options_), nullptr);
}

TEST_F(SchemaTest, AFileTellsItsVersionWithoutSqlite) {
  for (std::size_t version = 1; version <= schema_steps().size(); ++version) {
    const fs::path file = folder_.path() / ("version_" + std::to_string(version) + ".db");
    restore(frozen(version), file);
    const Expected<std::int64_t> told = peek_store_version(file);
    ASSERT_TRUE(told.ok()) << told.failure();
    EXPECT_EQ(*told, static_cast<std::int64_t>(version));
  }
  const std::unique_ptr<Store> store = open_or_fail(options_);
  const Expected<std::int64_t> told = peek_store_version(options_.file);
  ASSERT_TRUE(told.ok()) << "while it is in use: " << told.failure();
  EXPECT_EQ(*told, static_cast<std::int64_t>(schema_steps().size()));
}

TEST_F(SchemaTest, AFileTellsThatItIsNewerOrNoStore) {
  EXPECT_EQ(*peek_store_version(options_.file), 0) << "there is none";
  std::ofstream{options_.file};
  EXPECT_EQ(*peek_store_version(options_.file), 0) << "it is empty";
  std::ofstream(options_.file) << std::string(5000, 'x');
  EXPECT_NE(peek_store_version(options_.file).failure().find("a database of another program"),
            std::string::npos);
  fs::remove(options_.file);
  restore(frozen(1), options_.file);
  const auto run = [&](const char* sql) {
    sqlite3* handle = nullptr;
    EXPECT_EQ(sqlite3_open(options_.file.c_str(), &handle), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(handle, sql, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(handle);
  };
  run("PRAGMA user_version = 1000");
  // As the hub that opens it says it.
  const Expected<OpenedStore> opened = open_store(options_, at(kMorningMs));
  ASSERT_FALSE(opened.ok());
  EXPECT_EQ(peek_store_version(options_.file).failure(), opened.failure());
  run("PRAGMA user_version = 1; PRAGMA application_id = 7");
  EXPECT_NE(peek_store_version(options_.file).failure().find("a database of another program"),
            std::string::npos);
}

// Steps of a later program, of which one does not work.
TEST_F(SchemaTest, EachStepIsDoneWholeOrNotAtAll) {
  std::vector<const char*> steps(schema_steps().begin(), schema_steps().end());
  steps.push_back("CREATE TABLE later (name TEXT)");
  steps.push_back("INSERT INTO later VALUES ('a'); CREATE TABLE later (name TEXT)");
  const std::unique_ptr<Store> store = open_or_fail(options_);
  Database& database = store->database();
  const auto first = static_cast<std::int64_t>(schema_steps().size());
  for (int attempt = 0; attempt < 2; ++attempt) {
    const Expected<std::int64_t> migrated = migrate_schema(database, steps);
    ASSERT_FALSE(migrated.ok());
    EXPECT_NE(migrated.failure().find("cannot be brought to version " + std::to_string(first + 2)),
              std::string::npos)
        << migrated.failure();
    EXPECT_EQ(*database.integer("test", "PRAGMA user_version"), first + 1);
    EXPECT_EQ(*database.integer("test", "SELECT count(*) FROM later"), 0);
  }
  steps.back() = "INSERT INTO later VALUES ('b')";
  const Expected<std::int64_t> migrated = migrate_schema(database, steps);
  ASSERT_TRUE(migrated.ok()) << migrated.failure();
  EXPECT_EQ(*migrated, first + 1);
  EXPECT_EQ(*database.integer("test", "SELECT count(*) FROM later"), 1);
  EXPECT_FALSE(check_schema(database).ok()) << "this program does not know it";
}

}  // namespace
}  // namespace traygauge::test
