#include "firmware/config/station_writing.hpp"

#include <gtest/gtest.h>

#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

constexpr const char* kText = R"(# First line.
[camera]
# device = "/dev/video1"
device = "name:Cam #1"   # over the tray
width = 1600

[button]
line = "gpiochip0/17"
# [trays]
)";

TEST(StationWriting, ReplacesAValueAndKeepsItsComment) {
  const std::string text = with_value(kText, "camera", "device", "\"serial:A1\"");
  EXPECT_NE(text.find("\ndevice = \"serial:A1\"  # over the tray\nwidth = 1600\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("# device = \"/dev/video1\"\n"), std::string::npos) << text;
  EXPECT_EQ(with_value(text, "camera", "device", "\"name:Cam #1\" "),
            with_value(kText, "camera", "device", "\"name:Cam #1\" "));
}

TEST(StationWriting, AddsWhatIsNotThere) {
  EXPECT_NE(with_value(kText, "button", "debounce_ms", "20").find("[button]\ndebounce_ms = 20\nline"),
            std::string::npos);
  // A table in a comment is none; a key of that name in another table is another.
  EXPECT_TRUE(with_value(kText, "trays", "width", "2").ends_with("# [trays]\n\n[trays]\nwidth = 2\n"));
  EXPECT_EQ(with_value("", "trays", "items", "3"), "[trays]\nitems = 3\n");
}

TEST(StationWriting, RemovesAValueAlone) {
  const std::string text = without_value(kText, "camera", "width");
  EXPECT_EQ(text.find("width"), std::string::npos) << text;
  EXPECT_EQ(with_value(text, "button", "line", "\"gpiochip0/17\""), text);
  EXPECT_EQ(without_value(kText, "button", "width"), kText);
  EXPECT_EQ(without_value(kText, "lens", "width"), kText);
}

TEST(StationWriting, WritesNothingThatIsNoStationFile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "station.toml";
  write_text(file, kText);
  EXPECT_THROW(write_station_value(file, "camera", "width", "\"wide\""), InputError);
  EXPECT_THROW(remove_station_value(file, "camera", "device"), InputError);
  EXPECT_EQ(read_text(file), kText);
  write_station_value(file, "trays", "items", "3");
  EXPECT_EQ(read_station_file(file).items, 3);
  remove_station_value(file, "trays", "items");
  EXPECT_EQ(read_station_file(file).items, 0);
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".new"));
}

}  // namespace
}  // namespace traygauge
