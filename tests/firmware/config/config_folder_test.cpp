#include "firmware/config/config_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "simulator/capture/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

TEST(ConfigFolder, IsTheNearestAboveThatHasThePart) {
  const TemporaryFolder folder;
  const fs::path programs = folder.path() / "checkout" / "build" / "tests";
  fs::create_directories(programs);
  fs::create_directories(folder.path() / "checkout" / "config" / "network");
  fs::create_directories(folder.path() / "share" / "traygauge" / "config" / "plots");
  EXPECT_EQ(find_config_above(programs, "network", "it", ""), folder.path() / "checkout" / "config");
  EXPECT_EQ(find_config_above(programs, "plots", "it", ""), folder.path() / "share" / "traygauge" / "config");
}

TEST(ConfigFolder, WhatIsNowhereIsAnErrorThatSaysWhatToDo) {
  const TemporaryFolder folder;
  try {
    find_config_above(folder.path(), "plots", "the folder with plots/", "pass --config DIR");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected the folder with plots/"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("pass --config DIR"), std::string::npos);
  }
}

}  // namespace
}  // namespace traygauge
