// `traygauge network`, as a person types it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/base/little_endian.hpp"
#include "firmware/network/network_sheet.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/support/network_composer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

void write_bytes(const fs::path& file, const std::vector<std::byte>& bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// Two layers that call a cell food where it is redder than green, and show border and embedding.
test::ComposedNetwork red_finder() {
  test::ComposedNetwork network;
  network.width = 32;
  network.height = 24;
  network.provenance = "seed 7\nred against green";
  network.layers.resize(3);
  for (test::ComposedLayer& layer : network.layers) {
    layer.kernel = 1;
    layer.stride = 2;
    layer.has_relu = false;
    layer.sources = {{0}};
  }
  network.layers[0].role = NetworkRole::classes;
  network.layers[0].channels = 2;
  network.layers[0].weights = {0, 1, 0, 1, 0, 0};
  network.layers[1].role = NetworkRole::border;
  network.layers[1].weights = {0, 0, 1};
  network.layers[2].role = NetworkRole::embedding;
  network.layers[2].channels = 8;
  network.layers[2].weights.assign(8 * 3, 1);
  for (test::ComposedLayer& layer : network.layers) {
    const auto channels = static_cast<std::size_t>(layer.channels);
    layer.biases.assign(channels, 0);
    layer.multipliers.assign(channels, 1);
    layer.shifts.assign(channels, 1);
  }
  test::add_test_vector(network);
  return network;
}

class NetworkCommand : public ::testing::Test {
 protected:
  std::string path(const char* name) const { return (folder_.path() / name).string(); }
  std::string write(const char* name, const std::vector<std::byte>& bytes) const {
    write_bytes(path(name), bytes);
    return path(name);
  }
  // Left half red, right half green.
  std::string write_picture() const {
    cv::Mat3b picture(240, 320, cv::Vec3b(0, 200, 0));
    picture(cv::Rect(0, 0, 160, 240)).setTo(cv::Vec3b(0, 0, 200));
    cv::imwrite(path("picture.png"), picture);
    return path("picture.png");
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(NetworkCommand, SaysWhatTheFileHolds) {
  const CommandResult result = run({"network", write("a.tgn", compose_network(red_finder()))});
  EXPECT_EQ(result.status, 0) << result.error;
  for (const char* told : {"16 x 12 x 8", "embedding", "red against green", "test vector", "33"}) {
    EXPECT_NE(result.out.find(told), std::string::npos) << told << "\n" << result.out;
  }
  EXPECT_EQ(result.out.find("share"), std::string::npos);
}

TEST_F(NetworkCommand, RunsOnAPictureAndDrawsIt) {
  const std::string file = write("a.tgn", compose_network(red_finder()));
  const CommandResult result = run({"network", file, "--picture", write_picture(), "-o", path("sheet.png")});
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_NE(result.out.find("50.0 %"), std::string::npos) << result.out;
  const cv::Mat3b sheet = cv::imread(path("sheet.png"));
  ASSERT_EQ(sheet.size(), cv::Size(4 * 32, 24));
  EXPECT_EQ(sheet(12, 5), cv::Vec3b(0, 0, 200));
  EXPECT_EQ(sheet(12, 32 + 5), class_colour(1));
  EXPECT_EQ(sheet(12, 32 + 25), class_colour(0));
  EXPECT_EQ(sheet(12, 64 + 5), cv::Vec3b::all(128));  // no blue: as likely as not
  EXPECT_EQ(sheet(12, 96 + 5), cv::Vec3b::all(228));  // 128 and 200 halved
}

// A picture in portrait fills the middle alone; the grey beside it counts for nothing.
TEST_F(NetworkCommand, CountsTheClassesOfThePictureAlone) {
  const std::string file = write("a.tgn", compose_network(red_finder()));
  cv::imwrite(path("tall.png"), cv::Mat3b(320, 160, cv::Vec3b(0, 0, 200)));
  const CommandResult result = run({"network", file, "--picture", path("tall.png")});
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_NE(result.out.find("100.0 %"), std::string::npos) << result.out;
}

struct BadFile {
  std::string file;
  const char* told;
};

TEST_F(NetworkCommand, EndsWithASentenceForAFileThatCannotBeUsed) {
  const std::vector<std::byte> whole = compose_network(red_finder());
  std::vector<std::byte> damaged = whole;
  damaged[whole.size() / 2] ^= std::byte{4};
  test::ComposedNetwork newer = red_finder();
  newer.version = 2;
  test::ComposedNetwork other = red_finder();
  ++other.vector.output_crc;
  test::ComposedNetwork contradictory = red_finder();
  contradictory.layers[0].stride = 3;
  test::ComposedNetwork many = red_finder();
  many.width = many.height = 1000;
  test::ComposedNetwork wide = red_finder();
  wide.classes.resize(33, "x");
  const std::vector<BadFile> files = {
      {path("absent.tgn"), "absent.tgn"},
      {write("foreign.tgn", std::vector<std::byte>(500, std::byte{'x'})), "another kind"},
      {write("empty.tgn", {}), "another kind"},
      {write("damaged.tgn", damaged), "checksum"},
      {write("short.tgn", {whole.begin(), whole.begin() + 100}), "checksum"},
      {write("newer.tgn", compose_network(newer)), "version 2"},
      {write("contradictory.tgn", compose_network(contradictory)), "contradict"},
      {write("other.tgn", compose_network(other)), "test vector"},
      {write("many.tgn", compose_network(many)), "MiB"},
      {write("wide.tgn", compose_network(wide)), "train a smaller one"},
      {fs::temp_directory_path().string(), "folder"},
  };
  for (const BadFile& bad : files) {
    const CommandResult result = run({"network", bad.file});
    EXPECT_EQ(result.status, 2) << bad.file;
    EXPECT_EQ(result.out, "") << bad.file;
    EXPECT_NE(result.error.find(bad.told), std::string::npos) << bad.told << ": " << result.error;
    EXPECT_NE(result.error.find(bad.file), std::string::npos) << result.error;
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
}

TEST_F(NetworkCommand, RefusesWrongUse) {
  const std::string file = write("a.tgn", compose_network(red_finder()));
  EXPECT_EQ(run({"network"}).status, 2);
  EXPECT_EQ(run({"network", file, "-o", path("sheet.png")}).status, 2);
  EXPECT_EQ(run({"network", file, "--picture", file}).status, 2);
  EXPECT_EQ(run({"network", file, "--picture", write_picture(), "-o", path("absent/sheet.png")}).status, 2);
}

}  // namespace
}  // namespace traygauge
