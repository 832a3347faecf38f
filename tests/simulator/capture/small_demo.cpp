#include "tests/simulator/capture/small_demo.hpp"

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

void halve_picture(const fs::path& from, const fs::path& to, int interpolation) {
  const cv::Mat whole = cv::imread(from, cv::IMREAD_UNCHANGED);
  cv::Mat half;
  cv::resize(whole, half, whole.size() / 2, 0.0, 0.0, interpolation);
  if (!cv::imwrite(to, half, {cv::IMWRITE_JPEG_QUALITY, 95}))
    throw std::runtime_error("could not write " + to.string());
}

void halve_capture(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  nlohmann::json document = nlohmann::json::parse(read_text(from / "capture.json"));
  nlohmann::json& camera = document["camera"];
  for (const char* size : {"width", "height"}) camera[size] = camera[size].get<int>() / 2;
  for (const char* focal : {"fx", "fy"}) camera[focal] = camera[focal].get<double>() / 2.0;
  // Pixels have whole numbers in their middle.
  for (const char* middle : {"cx", "cy"}) camera[middle] = (camera[middle].get<double>() + 0.5) / 2.0 - 0.5;
  write_text(to / "capture.json", document.dump(1));
  fs::copy(from / "card.png", to / "card.png");
  for (const nlohmann::json& view : document["views"]) {
    const std::string image = view["image"];
    const std::string labels = view["labels"];
    halve_picture(from / image, to / image, cv::INTER_AREA);
    halve_picture(from / labels, to / labels, cv::INTER_NEAREST);
  }
}

}  // namespace

SmallDemo::SmallDemo() {
  for (const char* tray : {"fish_and_potatoes", "mash_and_meatballs"})
    halve_capture(fs::path(TRAYGAUGE_SOURCE_DIR) / "simulator" / "demo" / tray, folder() / tray);
}

}  // namespace traygauge
