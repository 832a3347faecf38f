// The kernel's disk and the recorded one keep the same contract.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "firmware/journal/posix_file_system.hpp"
#include "tests/support/recorded_file_system.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

struct Rig {
  virtual ~Rig() = default;
  virtual FileSystem& disk() = 0;
  virtual std::string path(const std::string& name) = 0;
};

struct PosixRig : Rig {
  FileSystem& disk() override { return posix_file_system(); }
  std::string path(const std::string& name) override { return (folder.path() / name).string(); }
  TemporaryFolder folder;
};

struct RecordedRig : Rig {
  FileSystem& disk() override { return recorded; }
  std::string path(const std::string& name) override { return "folder/" + name; }
  RecordedFileSystem recorded;
};

struct Maker {
  const char* name;
  std::unique_ptr<Rig> (*make)();
};

class FileSystemContract : public testing::TestWithParam<Maker> {
 protected:
  std::unique_ptr<File> open(const std::string& name, OpenMode mode) {
    auto opened = rig_->disk().open(rig_->path(name), mode);
    EXPECT_TRUE(opened.ok()) << opened.error.message();
    return std::move(opened.value);
  }
  FileSystem& disk() { return rig_->disk(); }
  std::string path(const std::string& name) { return rig_->path(name); }

 private:
  std::unique_ptr<Rig> rig_ = GetParam().make();
};

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

std::string text_at(File& file, std::uint64_t offset_bytes, std::size_t count) {
  std::string text(count, '?');
  const auto read = file.read_at(offset_bytes, std::as_writable_bytes(std::span(text)));
  EXPECT_TRUE(read.ok());
  return text.substr(0, read.value);
}

TEST_P(FileSystemContract, ReadsWhatWasWrittenUpToTheEnd) {
  const auto file = open("a", OpenMode::existing_or_new);
  EXPECT_FALSE(file->write_at(0, bytes_of("0123456789")));
  EXPECT_FALSE(file->write_at(8, bytes_of("abcd")));
  EXPECT_EQ(text_at(*file, 0, 20), "01234567abcd");
  EXPECT_EQ(text_at(*file, 10, 1), "c");
  EXPECT_EQ(text_at(*file, 12, 5), "");
  EXPECT_EQ(text_at(*file, 100, 5), "");
  EXPECT_FALSE(file->write_at(14, bytes_of("z")));
  EXPECT_EQ(text_at(*file, 10, 20), std::string("cd\0\0z", 5));
  EXPECT_EQ(file->size_bytes().value, 15U);
  EXPECT_FALSE(file->sync_data());
}

TEST_P(FileSystemContract, OpensByMode) {
  EXPECT_EQ(disk().open(path("a"), OpenMode::existing).error, std::errc::no_such_file_or_directory);
  EXPECT_FALSE(open("a", OpenMode::existing_or_new)->write_at(0, bytes_of("abc")));
  EXPECT_EQ(open("a", OpenMode::existing)->size_bytes().value, 3U);
  EXPECT_EQ(open("a", OpenMode::existing_or_new)->size_bytes().value, 3U);
  EXPECT_EQ(open("a", OpenMode::emptied)->size_bytes().value, 0U);
  EXPECT_EQ(open("b", OpenMode::emptied)->size_bytes().value, 0U);
}

TEST_P(FileSystemContract, ReservesRoomWithZerosAndNeverCuts) {
  const auto file = open("a", OpenMode::existing_or_new);
  EXPECT_FALSE(file->write_at(0, bytes_of("abc")));
  EXPECT_FALSE(file->reserve(5));
  EXPECT_EQ(text_at(*file, 0, 20), std::string("abc\0\0", 5));
  EXPECT_FALSE(file->reserve(2));
  EXPECT_EQ(file->size_bytes().value, 5U);
}

TEST_P(FileSystemContract, RenamesOverAndRemoves) {
  EXPECT_FALSE(open("new", OpenMode::emptied)->write_at(0, bytes_of("new")));
  const auto old = open("a", OpenMode::emptied);
  EXPECT_FALSE(old->write_at(0, bytes_of("old")));
  EXPECT_FALSE(disk().rename(path("new"), path("a")));
  EXPECT_FALSE(disk().sync_folder_of(path("a")));
  EXPECT_EQ(text_at(*open("a", OpenMode::existing), 0, 9), "new");
  EXPECT_EQ(text_at(*old, 0, 9), "old") << "who has it open goes on with it";
  EXPECT_EQ(disk().rename(path("new"), path("a")), std::errc::no_such_file_or_directory);
  EXPECT_FALSE(disk().remove(path("a")));
  EXPECT_EQ(disk().remove(path("a")), std::errc::no_such_file_or_directory);
  EXPECT_EQ(disk().open(path("a"), OpenMode::existing).error, std::errc::no_such_file_or_directory);
}

TEST_P(FileSystemContract, LocksForOneObject) {
  auto first = open("a", OpenMode::existing_or_new);
  const auto second = open("a", OpenMode::existing_or_new);
  EXPECT_FALSE(first->try_lock());
  EXPECT_FALSE(first->try_lock());
  EXPECT_EQ(second->try_lock(), std::errc::resource_unavailable_try_again);
  first.reset();
  EXPECT_FALSE(second->try_lock());
}

TEST_P(FileSystemContract, GivesNumbersThatDiffer) {
  const auto first = disk().unique_number();
  const auto second = disk().unique_number();
  EXPECT_TRUE(first.ok() && second.ok());
  EXPECT_NE(first.value, second.value);
}

INSTANTIATE_TEST_SUITE_P(
    Disks, FileSystemContract,
    testing::Values(Maker{"Posix", []() -> std::unique_ptr<Rig> { return std::make_unique<PosixRig>(); }},
                    Maker{"Recorded",
                          []() -> std::unique_ptr<Rig> { return std::make_unique<RecordedRig>(); }}),
    [](const auto& param) { return std::string(param.param.name); });

TEST(PosixFileSystem, MakesFilesForTheirOwnerAlone) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "a").string();
  const auto file = posix_file_system().open(path, OpenMode::emptied);
  ASSERT_TRUE(file.ok());
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST(PosixFileSystem, SaysWhatTheKernelSaid) {
  const TemporaryFolder folder;
  FileSystem& disk = posix_file_system();
  EXPECT_EQ(disk.open(folder.path().string(), OpenMode::existing).error, std::errc::is_a_directory);
  EXPECT_EQ(disk.sync_folder_of((folder.path() / "absent" / "a").string()),
            std::errc::no_such_file_or_directory);
  // The kernel's file that is always full.
  const auto full = disk.open("/dev/full", OpenMode::existing);
  ASSERT_TRUE(full.ok());
  EXPECT_EQ(full.value->write_at(0, bytes_of("abc")), std::errc::no_space_on_device);
}

// The flags of the descriptor that this process has of `path`, as in open(2).
unsigned flags_of_descriptor(const std::string& path) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code ignored;
    if (std::filesystem::read_symlink(entry.path(), ignored) != path) continue;
    std::ifstream info("/proc/self/fdinfo/" + entry.path().filename().string());
    for (std::string key; info >> key;) {
      unsigned flags = 0;
      if (key == "flags:" && info >> std::oct >> flags) return flags;
    }
  }
  ADD_FAILURE() << path << " is not open";
  return 0;
}

TEST(PosixFileSystem, HandsNoFileToProgramsThatItStarts) {
  const TemporaryFolder folder;
  const std::string path = (std::filesystem::canonical(folder.path()) / "a").string();
  const auto file = posix_file_system().open(path, OpenMode::emptied);
  EXPECT_NE(flags_of_descriptor(path) & unsigned{O_CLOEXEC}, 0U);
}

// With a limit to the size of files the kernel writes a part first, then refuses the rest.
TEST(PosixFileSystem, TakesAShortWriteForNone) {
  const TemporaryFolder folder;
  const auto file = posix_file_system().open((folder.path() / "a").string(), OpenMode::emptied);
  ASSERT_TRUE(file.ok());
  rlimit usual{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &usual), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limited{5, usual.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limited), 0);
  const std::error_code error = file.value->write_at(0, bytes_of("0123456789"));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &usual), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(error, std::errc::file_too_large);
  EXPECT_EQ(text_at(*file.value, 0, 20), "01234");
}

}  // namespace
}  // namespace traygauge::test
