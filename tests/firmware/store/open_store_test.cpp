#include "firmware/store/open_store.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <random>

#include "firmware/store/damaged_files.hpp"
#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/open_sample.hpp"
#include "tests/firmware/store/recorded_disk.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

class OpenStoreTest : public testing::Test {
 protected:
  OpenStoreTest() { options_.file = folder_.path() / "results.db"; }

  void make_store(std::uint64_t scans) {
    const std::unique_ptr<Store> store = open_or_fail(options_);
    ASSERT_NE(store, nullptr);
    for (std::uint64_t number = 1; number <= scans; ++number) {
      ASSERT_TRUE(store->scans().put(sample_document(number), at(kMorningMs)).ok());
    }
  }
  void run_sql(const char* sql) {
    sqlite3* handle = nullptr;
    ASSERT_EQ(sqlite3_open(options_.file.c_str(), &handle), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(handle, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(handle);
    sqlite3_close(handle);
  }
  FileBytes bytes() { return read_files(folder_.path()).at("results.db"); }
  void write(const FileBytes& bytes) { write_files(folder_.path(), {{"results.db", bytes}}); }
  std::string failure() {
    const Expected<OpenedStore> opened = open_store(options_, at(kMorningMs));
    return opened.ok() ? "" : opened.failure();
  }
  void expect_failure(const char* part) {
    const std::string text = failure();
    EXPECT_NE(text.find(part), std::string::npos) << "'" << text << "' lacks '" << part << "'";
    EXPECT_NE(text.find(options_.file.string()), std::string::npos) << text;
  }

  MemoryFolder folder_;
  StoreOptions options_;
};

TEST_F(OpenStoreTest, SetsWhatDurabilityNeeds) {
  make_store(1);
  const std::unique_ptr<Store> store = open_or_fail(options_);
  const auto setting = [&](const std::string& name) {
    std::string value;
    EXPECT_TRUE(
        store->database()
            .each("test", ("PRAGMA " + name).c_str(), [&](const Statement& row) { value = row.text(0); })
            .ok());
    return value;
  };
  EXPECT_EQ(setting("journal_mode"), "persist");
  EXPECT_EQ(setting("synchronous"), "2");
  EXPECT_EQ(setting("locking_mode"), "exclusive");
  EXPECT_EQ(setting("auto_vacuum"), "0");
  EXPECT_EQ(setting("foreign_keys"), "1");
  EXPECT_EQ(setting("page_size"), "1024");
  EXPECT_EQ(setting("secure_delete"), "0");
  const std::string mapped = setting("mmap_size");
  EXPECT_TRUE(mapped.empty() || mapped == "0") << mapped;
  EXPECT_GT(fs::file_size(options_.file.string() + "-journal"), 0U);
}

TEST_F(OpenStoreTest, ASecondHubIsToldSo) {
  const std::unique_ptr<Store> store = open_or_fail(options_);
  expect_failure("another hub uses this store");
  ASSERT_TRUE(store->scans().put(sample_document(1), at(kMorningMs)).ok());
}

TEST_F(OpenStoreTest, AnotherProgramCannotWriteMeanwhile) {
  const std::unique_ptr<Store> store = open_or_fail(options_);
  const std::string file = options_.file.string();
  const pid_t other = ::fork();
  if (other == 0) {
    sqlite3* handle = nullptr;
    sqlite3_open(file.c_str(), &handle);
    ::_exit(sqlite3_exec(handle, "DELETE FROM scans", nullptr, nullptr, nullptr) == SQLITE_BUSY ? 0 : 1);
  }
  int status = 1;
  ASSERT_EQ(::waitpid(other, &status, 0), other);
  EXPECT_EQ(status, 0);
}

TEST_F(OpenStoreTest, OpensAfterAHubWasKilled) {
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  const pid_t hub = ::fork();
  if (hub == 0) {
    const Expected<OpenedStore> opened = open_store(options_, at(kMorningMs));
    for (std::uint64_t number = 1; opened.ok(); ++number) {
      if (!opened->store->scans().put(sample_document(number), at(kMorningMs)).ok()) break;
      if (::write(pipe[1], &number, sizeof(number)) != sizeof(number)) break;
    }
    ::_exit(1);
  }
  ::close(pipe[1]);
  std::uint64_t confirmed = 0;
  for (int i = 0; i < 20; ++i) ASSERT_EQ(::read(pipe[0], &confirmed, sizeof(confirmed)), 8);
  ::kill(hub, SIGKILL);
  ASSERT_EQ(::waitpid(hub, nullptr, 0), hub);
  while (::read(pipe[0], &confirmed, sizeof(confirmed)) == 8) continue;
  ::close(pipe[0]);
  const std::unique_ptr<Store> store = open_or_fail(options_);
  ASSERT_NE(store, nullptr);
  const auto scans = static_cast<std::uint64_t>(store->scans().totals()->counts.scans);
  EXPECT_TRUE(scans == confirmed || scans == confirmed + 1) << scans << " of " << confirmed;
}

TEST_F(OpenStoreTest, AFileThatIsNoDatabaseIsPutAside) {
  const FileBytes noise(5000, std::byte{'x'});
  write(noise);
  const Expected<OpenedStore> opened = open_store(options_, at(kMorningMs));
  ASSERT_TRUE(opened.ok()) << opened.failure();
  ASSERT_EQ(opened->notices.size(), 1U);
  const std::string aside = options_.file.string() + ".damaged-20261127T074000Z";
  EXPECT_NE(opened->notices[0].find(aside), std::string::npos) << opened->notices[0];
  EXPECT_EQ(read_files(folder_.path()).at("results.db.damaged-20261127T074000Z"), noise);
  EXPECT_TRUE(opened->store->scans().put(sample_document(1), at(kMorningMs)).ok());
}

// Any damage: the store opens as it was, or it is put aside whole. Reading what it holds never ends the
// program.
TEST_F(OpenStoreTest, WhateverIsDamagedIsNoticedOrHarmless) {
  std::mt19937_64 random(random_seed());
  make_store(20);
  const FileBytes sound = bytes();
  int aside = 0;
  for (int run = 0; run < 500; ++run) {
    FileBytes damaged = sound;
    const std::size_t kind = random() % 3;
    if (kind == 0) damaged.resize(random() % damaged.size());
    const std::size_t flaws = kind == 1 ? 1 + random() % 3 : 400;
    const std::size_t begin = damaged.empty() ? 0 : random() % damaged.size();
    for (std::size_t i = 0; i < flaws && kind != 0; ++i) {
      const std::size_t place = kind == 1 ? random() : begin + i;
      damaged[place % damaged.size()] = static_cast<std::byte>(random());
    }
    write(damaged);
    const Expected<OpenedStore> opened = open_store(options_, at(kMorningMs));
    if (!opened.ok()) {
      const bool is_refused = opened.failure().find("another program") != std::string::npos ||
                              opened.failure().find("has version") != std::string::npos;
      EXPECT_TRUE(is_refused) << opened.failure();
      EXPECT_EQ(bytes(), damaged) << "a refused file stays as it is";
      continue;
    }
    Store& store = *opened->store;
    (void)store.history().page({}, 100).ok();
    (void)store.corrections().corrected({"kitchen", 7}).ok();
    if (!opened->notices.empty()) {
      ++aside;
      EXPECT_EQ(store.scans().totals()->counts.scans, 0);
      EXPECT_EQ(list_damaged_files(options_.file)->size(), 1U);
      EXPECT_EQ(read_files(folder_.path()).at("results.db.damaged-20261127T074000Z"), damaged);
      EXPECT_TRUE(store.scans().put(sample_document(1), at(kMorningMs)).ok());
    }
  }
  EXPECT_GT(aside, 30);
}

TEST_F(OpenStoreTest, AStrangeJournalDoesNoHarm) {
  std::mt19937_64 random(random_seed());
  make_store(5);
  const FileBytes sound = bytes();
  for (int run = 0; run < 50; ++run) {
    FileBytes journal(random() % 5000);
    for (std::byte& byte : journal) byte = static_cast<std::byte>(random());
    write_files(folder_.path(), {{"results.db", sound}, {"results.db-journal", journal}});
    const std::unique_ptr<Store> store = open_or_fail(options_);
    ASSERT_NE(store, nullptr);
    ASSERT_EQ(store->scans().totals()->counts.scans, 5);
    ASSERT_TRUE(store->scans().put(sample_document(6), at(kMorningMs)).ok());
  }
}

TEST_F(OpenStoreTest, DamagedFilesAreKeptUpToTheLimitAndDeletedWithANotice) {
  options_.max_damaged_files = 2;
  std::vector<std::string> notices;
  for (int i = 0; i < 4; ++i) {
    DiskFiles files = read_files(folder_.path());
    files["results.db"] = FileBytes(5000, static_cast<std::byte>('a' + i));
    write_files(folder_.path(), files);
    // The second and the third in the same second.
    const Expected<OpenedStore> opened = open_store(options_, at(kMorningMs + (i < 2 ? i : i - 1) * 1000));
    ASSERT_TRUE(opened.ok()) << opened.failure();
    notices.insert(notices.end(), opened->notices.begin(), opened->notices.end());
  }
  ASSERT_EQ(notices.size(), 6U);
  EXPECT_NE(notices[3].find("results.db.damaged-20261127T074000Z was deleted"), std::string::npos)
      << notices[3];
  const auto left = list_damaged_files(options_.file);
  ASSERT_TRUE(left.ok());
  ASSERT_EQ(left->size(), 2U);
  EXPECT_EQ(read_files(folder_.path()).at(left->at(1).filename())[0], std::byte{'d'});
}

TEST_F(OpenStoreTest, WhatBelongsToADamagedFileGoesWithIt) {
  write_files(folder_.path(), {{"results.db", FileBytes(5000, std::byte{'x'})},
                               {"results.db-wal", FileBytes(3, std::byte{'w'})}});
  const Expected<fs::path> aside = move_aside(options_.file, kMorningMs);
  ASSERT_TRUE(aside.ok()) << aside.failure();
  EXPECT_TRUE(fs::exists(aside->string() + "-wal"));
  EXPECT_FALSE(fs::exists(options_.file.string() + "-wal"));
  EXPECT_EQ(list_damaged_files(options_.file)->size(), 1U);
  EXPECT_EQ(limit_damaged_files(options_.file, 0)->size(), 1U);
  EXPECT_TRUE(read_files(folder_.path()).empty());
}

TEST_F(OpenStoreTest, AnotherProgramsDatabaseIsRefusedAndLeft) {
  run_sql("CREATE TABLE photographs (name TEXT)");
  const FileBytes before = bytes();
  expect_failure("database of another program");
  EXPECT_EQ(bytes(), before);
}

TEST_F(OpenStoreTest, ATableThatIsDefinedOtherwiseIsDamage) {
  make_store(3);
  run_sql("CREATE VIEW mine AS SELECT * FROM scans");
  EXPECT_NE(open_or_fail(options_), nullptr) << "what somebody added does no harm";
  run_sql(
      "PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(sql, 'attempts', 'attemptz')"
      " WHERE name = 'deliveries'");
  const Expected<OpenedStore> opened = open_store(options_, at(kMorningMs));
  ASSERT_TRUE(opened.ok()) << opened.failure();
  ASSERT_EQ(opened->notices.size(), 1U);
  EXPECT_NE(opened->notices[0].find("the definition of a table"), std::string::npos) << opened->notices[0];
}

TEST_F(OpenStoreTest, AFileInAnotherJournalModeIsTakenOver) {
  make_store(3);
  run_sql("PRAGMA journal_mode = WAL; DELETE FROM scans WHERE number = 2");
  const std::unique_ptr<Store> store = open_or_fail(options_);
  ASSERT_NE(store, nullptr);
  EXPECT_TRUE(*store->scans().find({"kitchen", 3}));
  EXPECT_TRUE(store->scans().put(sample_document(4), at(kMorningMs)).ok());
}

TEST_F(OpenStoreTest, FollowsALinkToItsFolder) {
  fs::create_directory(folder_.path() / "data");
  fs::create_symlink("data/results.db", options_.file);
  make_store(1);
  EXPECT_TRUE(fs::is_symlink(options_.file));
  EXPECT_TRUE(fs::is_regular_file(folder_.path() / "data/results.db"));
  EXPECT_FALSE(failure().size());
}

TEST_F(OpenStoreTest, TellsOfItsProgress) {
  make_store(1000);
  int calls = 0;
  options_.on_progress = [&] { ++calls; };
  EXPECT_NE(open_or_fail(options_), nullptr);
  EXPECT_GT(calls, 3);
}

TEST_F(OpenStoreTest, AFolderThatIsMissingOrAFolderAsFileIsToldSo) {
  options_.file = folder_.path() / "missing" / "results.db";
  expect_failure("Check that the folder exists");
  options_.file = folder_.path() / "results.db";
  fs::create_directory(options_.file);
  expect_failure("cannot be opened");
}

// What somebody without the rights of root is told.
std::string failure_without_rights(const StoreOptions& options) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) return "no pipe";
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    if (::getuid() == 0 && (::setgid(kNobody) != 0 || ::setuid(kNobody) != 0)) ::_exit(2);
    const Expected<OpenedStore> opened = open_store(options, at(kMorningMs));
    const std::string text = opened.ok() ? "opened" : opened.failure();
    ::_exit(::write(pipe[1], text.data(), text.size()) < 0 ? 1 : 0);
  }
  ::close(pipe[1]);
  std::array<char, 4096> text{};
  const ssize_t size = ::read(pipe[0], text.data(), text.size());
  ::close(pipe[0]);
  ::waitpid(child, nullptr, 0);
  return {text.data(), size < 0 ? 0 : static_cast<std::size_t>(size)};
}

TEST_F(OpenStoreTest, AFileOrFolderThatCannotBeWrittenIsToldSoAndLeft) {
  make_store(2);
  const FileBytes before = bytes();
  const auto all = fs::perms::all;
  fs::permissions(folder_.path(), all);
  fs::permissions(options_.file.string() + ".lock", all);
  fs::permissions(options_.file.string() + "-journal", all);
  fs::permissions(options_.file, fs::perms::owner_read | fs::perms::others_read);
  EXPECT_NE(failure_without_rights(options_).find("Make the file and its folder writable"), std::string::npos)
      << failure_without_rights(options_);
  fs::permissions(options_.file, all);
  fs::remove(options_.file.string() + ".lock");
  fs::permissions(folder_.path(), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                      fs::perms::others_exec);
  EXPECT_NE(failure_without_rights(options_).find("this user may write in it"), std::string::npos)
      << failure_without_rights(options_);
  fs::permissions(folder_.path(), all);
  EXPECT_EQ(failure_without_rights(options_), "opened");
  EXPECT_EQ(bytes(), before);
}

}  // namespace
}  // namespace traygauge::test
