#include "tests/evaluation/tables/fingerprint.hpp"

#include <opencv2/core/utility.hpp>
#include <ostream>
#include <sstream>

#include "firmware/config/dish_choice.hpp"
#include "simulator/capture/capture.hpp"
#include "simulator/capture/content_hash.hpp"
#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/picture.hpp"
#include "tests/evaluation/program_fingerprint.hpp"

namespace traygauge::tables {
namespace {

void describe_dish(const DishDescription& dish, std::ostream& text) {
  text << "dish " << dish.label;
  for (const double value :
       {dish.outer_size_mm[0], dish.outer_size_mm[1], dish.rim_height_mm, dish.bottom_height_mm})
    text << ' ' << value;
  for (const ProfilePoint& point : dish.profile) text << ' ' << point.inset_mm << ':' << point.height_mm;
  text << '\n';
}

}  // namespace

std::string describe_program() {
  std::ostringstream text;
  text << "core " << kCoreFingerprint << ", firmware " << kFirmwareFingerprint << ", simulator "
       << kSimulatorFingerprint << ", methods " << kMethodsFingerprint << ", OpenCV "
       << cv::getVersionString();
  return text.str();
}

const std::string& PairKeys::of_file(const std::filesystem::path& file) {
  const auto known = files_.find(file);
  if (known != files_.end()) return known->second;
  return files_[file] = content_hash(read_bytes({file, ""}, kMaxPictureFileBytes, "a readable file"));
}

const std::string& PairKeys::of_pair(const PairTask& task, const std::string& config) {
  const auto place = std::pair(task.folder, task.pair);
  const auto known = pairs_.find(place);
  if (known != pairs_.end()) return known->second;
  const Capture capture = read_capture(task.folder);
  std::ostringstream text;
  text.precision(17);
  text << "capture.json " << of_file(capture.file) << "\ncard " << of_file(capture.card.pattern.path)
       << "\npair " << task.pair[0] << ' ' << task.pair[1] << '\n';
  for (const int view : task.pair) {
    const ViewDescription& description = capture.views.at(static_cast<std::size_t>(view));
    text << "view " << of_file(description.image.path);
    if (description.labels) text << ' ' << of_file(description.labels->path);
    text << '\n';
  }
  for (const DishDescription& dish : choose_dishes(capture, config)) describe_dish(dish, text);
  return pairs_[place] = text.str();
}

std::string PairKeys::key_of(const PairTask& task, const Variant& variant, const std::string& config) {
  std::ostringstream text;
  text << describe_program() << '\n' << of_pair(task, config) << describe(variant);
  return text.str();
}

}  // namespace traygauge::tables
