// A small valid capture in a folder of its own, for tests to spoil.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace traygauge {

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

// 320 × 240, three views of noise (JPEG, JPEG, PNG), two items on a round dish, a card.
class TemporaryCapture {
 public:
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 240;

  TemporaryCapture();
  std::filesystem::path folder() const { return folder_.path(); }
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

  nlohmann::json document;  // store() puts it into capture.json
  void store() const;

 private:
  TemporaryFolder folder_;
};

// Label picture of the temporary capture: dish 1, items 2 and 3, card 255.
cv::Mat draw_labels(int width, int height);
cv::Mat draw_noise(int width, int height, int type, unsigned seed);

// Where the captures with truth are, by TRAYGAUGE_CAPTURES; empty when that is not set.
std::filesystem::path captures_folder();
// The capture folders there, and those below `root` at any depth, sorted.
std::vector<std::filesystem::path> capture_folders();
std::vector<std::filesystem::path> capture_folders(const std::filesystem::path& root);

}  // namespace traygauge
