#include "tests/simulator/capture/temporary_capture.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

namespace traygauge {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  // A new file each time: ext4 waits for the disk when an old one is cut to nothing and rewritten.
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  std::ofstream(file, std::ios::binary) << text;
}

cv::Mat draw_labels(int width, int height) {
  cv::Mat labels = cv::Mat::zeros(height, width, CV_8UC1);
  const cv::Point middle(width / 2, height / 2);
  cv::ellipse(labels, middle, {width * 3 / 10, height * 3 / 10}, 0, 0, 360, 1, cv::FILLED);
  cv::circle(labels, middle - cv::Point(width / 8, 0), height / 8, 2, cv::FILLED);
  cv::circle(labels, middle + cv::Point(width / 8, 0), height / 10, 3, cv::FILLED);
  cv::rectangle(labels, {4, 4, width / 6, height / 7}, 255, cv::FILLED);
  return labels;
}

cv::Mat draw_noise(int width, int height, int type, unsigned seed) {
  cv::Mat noise(height, width, type);
  cv::RNG random(seed);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, {0, 0}, 1.5);
  cv::normalize(noise, noise, 0, 255, cv::NORM_MINMAX);
  return noise;
}

TemporaryCapture::TemporaryCapture() {
  document = nlohmann::json::parse(R"({
    "version": 1,
    "camera": {"width": 320, "height": 240, "fx": 300.0, "fy": 300, "cx": 159.5, "cy": 119.5,
               "distortion": [0.0, 0.0, 0.0, 0.0, 0.0]},
    "card": {"pattern": "card.png", "width_mm": 85.6, "height_mm": 53.5, "thickness_mm": 0.8},
    "dish": {"style": "dinner", "outer_size_mm": [260.0, 260.0], "rim_height_mm": 22.0,
             "bottom_height_mm": 4.5, "profile": [[0, 21.4], [1.6, 22.0], [49, 4.5]]},
    "views": [{"image": "view_0.jpg", "labels": "labels_0.png", "arm_angle_deg": 0.0},
              {"image": "view_1.jpg", "labels": "labels_1.png", "arm_angle_deg": 18.0},
              {"image": "view_2.png", "labels": "labels_2.png"}],
    "pairs": [[0, 1], [1, 2]]})");
  store();
  cv::imwrite(file("card.png").string(), draw_noise(160, 100, CV_8UC1, 9));
  const std::array pictures = {"view_0.jpg", "view_1.jpg", "view_2.png"};
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    cv::imwrite(file(pictures[i]).string(), draw_noise(kWidth, kHeight, CV_8UC3, static_cast<unsigned>(i)));
    cv::imwrite(file("labels_" + std::to_string(i) + ".png").string(), draw_labels(kWidth, kHeight));
  }
}

void TemporaryCapture::store() const {
  write_text(file("capture.json"), document.dump(1));
}

std::filesystem::path captures_folder() {
  const char* folder = std::getenv("TRAYGAUGE_CAPTURES");
  return folder == nullptr ? "" : folder;
}

std::vector<std::filesystem::path> capture_folders() {
  if (captures_folder().empty()) return {};
  return capture_folders(captures_folder());
}

std::vector<std::filesystem::path> capture_folders(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().filename() == "capture.json") folders.push_back(entry.path().parent_path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

}  // namespace traygauge
