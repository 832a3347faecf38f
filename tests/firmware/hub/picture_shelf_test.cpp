#include "firmware/hub/picture_shelf.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

class Pictures : public ::testing::Test {
 protected:
  static ScanId id(std::uint64_t number) { return {"kitchen", number}; }
  static std::string jpeg(std::size_t bytes = 100, char filling = 'x') {
    std::string bytes_of_one(bytes, filling);
    return bytes_of_one.replace(0, 3, "\xFF\xD8\xFF");
  }
  fs::path folder() const { return folder_.path() / "pictures"; }
  PictureShelfParams params() const { return {.folder = folder()}; }

  TemporaryFolder folder_;
};

TEST_F(Pictures, ThatAreShownNeverReachTheDisk) {
  PictureShelf shelf({.folder = folder(), .max_in_memory = 2});
  for (std::uint64_t i = 1; i <= 3; ++i) ASSERT_TRUE(shelf.show(id(i), jpeg()).ok());
  EXPECT_EQ(shelf.find(id(1)), nullptr);
  EXPECT_EQ(*shelf.find(id(3)), jpeg());
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(Pictures, TakeNoMoreMemoryThanTheyMay) {
  PictureShelf shelf({.folder = folder(), .max_bytes_in_memory = 250});
  for (std::uint64_t i = 1; i <= 3; ++i) ASSERT_TRUE(shelf.show(id(i), jpeg()).ok());
  EXPECT_EQ(shelf.find(id(1)), nullptr);
  EXPECT_NE(shelf.find(id(2)), nullptr);
}

TEST_F(Pictures, ThatAreKeptOutliveTheHub) {
  {
    PictureShelf shelf(params());
    ASSERT_TRUE(shelf.keep(id(1), jpeg(100, 'a')).ok());
    ASSERT_TRUE(shelf.keep(id(1), jpeg(100, 'b')).ok());
  }
  EXPECT_EQ(*PictureShelf(params()).find(id(1)), jpeg(100, 'b'));
  EXPECT_EQ(fs::status(folder()).permissions() & fs::perms::others_all, fs::perms::none);
}

TEST_F(Pictures, GoWithTheirScans) {
  PictureShelf shelf(params());
  for (std::uint64_t i = 1; i <= 3; ++i) ASSERT_TRUE(shelf.keep(id(i), jpeg()).ok());
  std::ofstream(folder() / "notes.txt") << "not ours";
  shelf.tidy([](const ScanId& scan) { return scan.number != 2; });
  EXPECT_TRUE(fs::exists(folder() / "kitchen-1.jpg"));
  EXPECT_FALSE(fs::exists(folder() / "kitchen-2.jpg"));
  EXPECT_TRUE(fs::exists(folder() / "notes.txt"));
}

TEST_F(Pictures, TheOldestGoWhereThereAreTooMany) {
  PictureShelf shelf({.folder = folder(), .max_in_memory = 1, .max_bytes_on_disk = 250});
  for (std::uint64_t i = 1; i <= 4; ++i) {
    ASSERT_TRUE(shelf.keep(id(i), jpeg()).ok());
    const auto age = std::chrono::hours(10 - i);
    fs::last_write_time(folder() / ("kitchen-" + std::to_string(i) + ".jpg"),
                        fs::file_time_type::clock::now() - age);
  }
  shelf.tidy([](const ScanId&) { return true; });
  for (std::uint64_t i = 1; i <= 4; ++i) EXPECT_EQ(shelf.find(id(i)) != nullptr, i > 2) << i;
}

TEST_F(Pictures, AreJpegs) {
  PictureShelf shelf(params());
  EXPECT_FALSE(shelf.show(id(1), "<svg>").ok());
  EXPECT_FALSE(shelf.keep(id(1), "").ok());
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(Pictures, ThatCannotBeKeptAreTold) {
  std::ofstream(folder_.path() / "file") << "no folder";
  PictureShelf shelf({.folder = folder_.path() / "file" / "pictures"});
  EXPECT_FALSE(shelf.keep(id(1), jpeg()).ok());
}

}  // namespace
}  // namespace traygauge::test
