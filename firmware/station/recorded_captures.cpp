#include "firmware/station/recorded_captures.hpp"

#include <algorithm>

#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/measure_choices.hpp"

namespace traygauge {

RecordedCaptures::RecordedCaptures(const std::vector<std::filesystem::path>& folders,
                                   const LabelChoice& labels) {
  for (const auto& folder : folders) add(folder, labels);
}

void RecordedCaptures::add(const std::filesystem::path& folder, const LabelChoice& labels) {
  const Capture capture = read_capture(folder);
  auto recording = std::make_unique<Recording>();
  recording->name = capture.file.parent_path().filename().string();
  const std::array<int, 2> pair = choose_pair("", capture);
  for (std::size_t i = 0; i < 2; ++i) {
    recording->views[i] = capture.views[static_cast<std::size_t>(pair[i])];
    largest_.width = std::max(largest_.width, recording->views[i].camera.size.width);
    largest_.height = std::max(largest_.height, recording->views[i].camera.size.height);
  }
  recording->labels = choose_labels(labels.source, capture, pair);
  check_hint(labels.items, recording->labels);
  needs_labels_ = needs_labels_ || recording->labels == LabelSource::automatic;
  recording->setup = set_up_pair(capture, pair, choose_dishes(capture, ""));
  Configuration parameters;
  parameters.segmentation.items = labels.items;
  recording->configuration = configure(recording->setup, parameters);
  recordings_.push_back(std::move(recording));
}

bool RecordedCaptures::open(std::size_t index) {
  open_ = recordings_[index].get();
  pair_ = {};
  try {
    for (std::size_t i = 0; i < 2; ++i) {
      loaded_[i] = load_view(open_->views[i]);
      pair_[i] = {loaded_[i].picture.frame(), {}, open_->views[i].arm_angle_deg};
      if (open_->labels == LabelSource::given) pair_[i].labels = loaded_[i].labels.gray();
    }
  } catch (const InputError& problem) {
    problem_ = problem.what();
    return false;
  }
  problem_.clear();
  return true;
}

FrameLimits RecordedCaptures::limits() const {
  const PictureSize size{largest_.width, largest_.height};
  return limits_for(size, size);
}

std::unique_ptr<MeasurableCaptures> open_recorded_captures(const std::vector<std::filesystem::path>& folders,
                                                           const LabelChoice& labels) {
  return std::make_unique<RecordedCaptures>(folders, labels);
}

}  // namespace traygauge
