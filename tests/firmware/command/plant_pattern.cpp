// Copies a capture and plants a pattern in the first row of each view: plant_pattern CAPTURE OUT. Prints the
// pattern in hexadecimal numbers. Grey pixels, so that it is the same in RGB and BGR.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <regex>
#include <string>
#include <vector>

int main(int argument_count, char** arguments) {
  if (argument_count != 3) return 2;
  const std::filesystem::path from = arguments[1];
  const std::filesystem::path out = arguments[2];
  std::filesystem::create_directories(out);
  std::random_device random;
  std::vector<int> pattern(256);
  for (int& value : pattern) value = static_cast<int>(random() % 256);
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(from)) {
    const std::filesystem::path file = entry.path();
    if (file.filename() == "capture.json") {
      std::ifstream stream(file);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      std::ofstream(out / file.filename()) << std::regex_replace(text, std::regex("\\.jpg\""), ".png\"");
    } else if (file.extension() == ".jpg") {
      cv::Mat picture = cv::imread(file.string());
      for (std::size_t x = 0; x < pattern.size(); ++x)
        picture.at<cv::Vec3b>(0, static_cast<int>(x)) =
            cv::Vec3b::all(static_cast<unsigned char>(pattern[x]));
      cv::imwrite((out / file.stem()).string() + ".png", picture);
    } else {
      std::filesystem::copy_file(file, out / file.filename());
    }
  }
  for (const int value : pattern) std::cout << std::hex << value << ' ';
  std::cout << '\n';
  return 0;
}
