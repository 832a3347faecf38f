#include "firmware/config/hub_tables.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "simulator/capture/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

constexpr const char* kStation =
    "[station]\nname = \"kitchen-2\"\nsocket = \"/run/hub\"\nfolder = \"waiting\"\n";
constexpr const char* kHub = "[hub]\nstore = \"results.db\"\n";

class HubTables : public ::testing::Test {
 protected:
  HubFile read(const std::string& text) const {
    std::ofstream(file()) << text;
    return read_hub_file(file(), file());
  }
  std::filesystem::path file() const { return folder_.path() / "station.toml"; }
  // The key that is blamed.
  std::string blamed(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      EXPECT_EQ(error.problem().file, file());
      return error.problem().key;
    }
    return "nothing";
  }

  TemporaryFolder folder_;
};

TEST_F(HubTables, PathsAreRelativeToTheFile) {
  const HubFile read_file = read(std::string(kStation) + kHub);
  EXPECT_EQ(read_file.socket, "/run/hub");
  EXPECT_EQ(read_file.hub.store, folder_.path() / "results.db");
  EXPECT_FALSE(read_file.hub.keep_days);
  EXPECT_EQ(read_file.hub.keep_free_mib, 500);
}

TEST_F(HubTables, EveryKeyArrives) {
  const HubFile read_file =
      read(std::string(kStation) + kHub + "keep_days = 30\nkeep_free_mib = 100\n[camera]\ndevice = \"x\"\n");
  EXPECT_EQ(read_file.hub.keep_days, 30);
  EXPECT_EQ(read_file.hub.keep_free_mib, 100);
}

TEST_F(HubTables, BlamesTheKey) {
  const std::string station = kStation;
  const std::string hub = kHub;
  EXPECT_EQ(blamed(hub), "station");
  EXPECT_EQ(blamed(station), "hub");
  EXPECT_EQ(blamed(station + "[hub]\n"), "hub.store");
  EXPECT_EQ(blamed(station + hub + "keep_dayz = 3\n"), "hub.keep_dayz");
  EXPECT_EQ(blamed(station + hub + "keep_days = 0\n"), "hub.keep_days");
  EXPECT_EQ(blamed(station + hub + "keep_free_mib = -1\n"), "hub.keep_free_mib");
  EXPECT_EQ(blamed(station + "waiting_mib = 0\n" + hub), "station.waiting_mib");
  EXPECT_EQ(blamed(station + "repeat_within_s = -1\n" + hub), "station.repeat_within_s");
  EXPECT_EQ(blamed("[station]\nname = \"Kitchen 2\"\nsocket = \"a\"\nfolder = \"b\"\n" + hub),
            "station.name");
}

TEST_F(HubTables, OfAnotherVersionAreRefused) {
  const std::string tables = std::string(kStation) + kHub;
  EXPECT_EQ(blamed(tables), "nothing") << "of version 1, as are all that do not say it";
  EXPECT_EQ(blamed("version = 1\n" + tables), "nothing");
  EXPECT_EQ(blamed("version = 0\n" + tables), "version");
  EXPECT_EQ(blamed("version = \"1\"\n" + tables), "version");
  // What else a newer file has is not what is wrong with it.
  EXPECT_EQ(blamed("version = 2\n[hub]\nunknown = 3\n"), "version");
  try {
    read("version = 2\n" + tables);
    ADD_FAILURE() << "it was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("version 1 of a station file"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("a newer program wrote this file"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace traygauge::test
