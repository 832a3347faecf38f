#include "simulator/devices/capture_folders.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace traygauge {
namespace {

namespace fs = std::filesystem;

class CaptureFolders : public testing::Test {
 protected:
  CaptureFolders() { fs::create_directories(root_); }
  ~CaptureFolders() override { fs::remove_all(root_); }
  void add_capture(const std::string& name) const {
    fs::create_directories(root_ / name);
    std::ofstream(root_ / name / "capture.json") << "{}";
  }
  const fs::path root_ = fs::path(testing::TempDir()) / ("capture_folders_" + std::to_string(getpid()));
};

TEST_F(CaptureFolders, OneCaptureIsItself) {
  add_capture("soup");
  EXPECT_EQ(find_capture_folders(root_ / "soup"), std::vector{root_ / "soup"});
}

TEST_F(CaptureFolders, ManyAreSortedByName) {
  for (const char* name : {"c", "a", "b"}) add_capture(name);
  fs::create_directories(root_ / "empty");
  std::ofstream(root_ / "notes.txt") << "no capture";
  EXPECT_EQ(find_capture_folders(root_), (std::vector{root_ / "a", root_ / "b", root_ / "c"}));
}

TEST_F(CaptureFolders, NothingIsNoError) {
  EXPECT_TRUE(find_capture_folders(root_).empty());
  EXPECT_TRUE(find_capture_folders(root_ / "absent").empty());
}

}  // namespace
}  // namespace traygauge
