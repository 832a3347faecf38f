#include "firmware/measure/capture_session.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "firmware/measure/card_outlines.hpp"
#include "firmware/measure/label_list.hpp"
#include "firmware/measure/view_reduction.hpp"
#include "firmware/network/food_network.hpp"

namespace traygauge {
namespace {

constexpr double kMaxCardStretch = 1.03;  // between the proportions of the pattern and of the card

const ViewDescription* view_of(const Capture& capture, int index) {
  return &capture.views[static_cast<std::size_t>(index)];
}

// Labels that the format gives no meaning to.
bool is_meaningless(std::size_t label) {
  return label == 200 || (label >= 250 && label <= 254);
}

bool holds(const std::vector<ReportedWarning>& warnings, const InputWarning& wanted) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const ReportedWarning& warning) { return warning.message == wanted.message; });
}

}  // namespace

CaptureSession::CaptureSession(const Capture& capture, std::array<int, 2> pair,
                               const std::vector<DishDescription>& dishes,
                               const ProfileParameters& parameters, LabelSource labels)
    : descriptions_{view_of(capture, pair[0]), view_of(capture, pair[1])},
      views_{load_view(*descriptions_[0]), load_view(*descriptions_[1])},
      setup_(set_up_pair(capture, pair, dishes)) {
  reduce_large_views();
  check_inputs();
  if (labels == LabelSource::automatic) {
    for (std::size_t i = 0; i < 2; ++i) std::swap(given_labels_[i], views_[i].labels);
  } else {
    outline_missing_cards(setup_, descriptions_, views_, warnings_);
  }
  build_estimators(capture, parameters, labels);
  if (labels == LabelSource::automatic) find_labels();
}

void CaptureSession::reduce_large_views() {
  for (std::size_t i = 0; i < 2; ++i) {
    setup_.lenses[i] = lens_of(reduce_where_larger(views_[i], descriptions_[i]->camera));
  }
}

void CaptureSession::build_estimators(const Capture& capture, const ProfileParameters& parameters,
                                      LabelSource labels) {
  Status status;
  if (parameters.profile == Profile::best || labels == LabelSource::automatic) {
    Configuration configuration = configure(setup_, parameters.best);
    if (labels == LabelSource::automatic) configuration.network = &food_network();
    tray_block_.emplace(required_bytes(configuration));
    tray_.emplace(tray_block_->bytes(), configuration);
    status = tray_->status();
  }
  if (parameters.profile == Profile::paper) {
    paper_ = open_paper_estimator(configure(setup_, parameters.paper));
    if (status.ok()) status = paper_->status();
  }
  if (!status.ok()) {
    throw InputError({capture.file, ""}, "a plausible camera, card and dish",
                     "values that contradict each other", sentence(status.code()));
  }
}

// measure() reports the failure of a view, too; its labels stay empty.
void CaptureSession::find_labels() {
  for (std::size_t i = 0; i < 2; ++i) static_cast<void>(tray_->add_view(input(i)));
  PairLabels& drawn = drawn_.emplace();
  drawn.segmentation = *tray_->segmentation();
  drawn.reserved_bytes = tray_->reserved_bytes();
  for (std::size_t i = 0; i < 2; ++i) {
    const ImageView<const std::uint8_t> labels = tray_->labels(i);
    Picture& picture = drawn.labels[i];
    picture = Picture({labels.width, labels.height}, PixelFormat::gray8);
    std::copy_n(labels.data, picture.pixels.size(), picture.pixels.begin());  // rows lie close
    views_[i].labels = picture;
  }
}

void CaptureSession::check_inputs() {
  for (std::size_t i = 0; i < 2; ++i) {
    if (!validate(setup_.lenses[i]).ok()) {
      const InputFile& place = descriptions_[i]->camera_place;
      throw InputError({place.path, place.key.empty() ? "distortion" : place.key + ".distortion"},
                       "coefficients that hold up to the corners of the picture", "a lens that folds it over",
                       "calibrate the camera again, with corners near the edge of the picture");
    }
    for (const InputWarning& warning : views_[i].warnings) {
      if (!holds(warnings_, warning)) warnings_.push_back({warning.code, warning.message});
    }
    const std::string unknown = list_labels(views_[i].labels, is_meaningless);
    if (!unknown.empty()) {
      warnings_.push_back({"labels_without_meaning", printable(descriptions_[i]->labels->path.string()) +
                                                         ": labels without a meaning (" + unknown +
                                                         ") count as background."});
    }
  }
  const CardDescription& card = setup_.card;
  const PictureSize pattern = setup_.pattern.size;
  const double stretch = card.width_mm * pattern.height / (card.height_mm * pattern.width);
  if (std::max(stretch, 1.0 / stretch) > kMaxCardStretch) {
    warnings_.push_back(
        {"card_proportions_differ",
         printable(card.pattern.path.string()) +
             ": the proportions of the pattern differ from card.width_mm and card.height_mm."});
  }
}

ViewInput CaptureSession::input(std::size_t i) const {
  ViewInput input;
  input.frame = views_[i].picture.frame();
  input.labels = views_[i].labels.gray();
  if (setup_.lenses[i] != setup_.lenses[0]) input.lens = setup_.lenses[i];
  input.arm_angle_deg = descriptions_[i]->arm_angle_deg;
  return input;
}

const Measurement& CaptureSession::measure(std::uint64_t seed, StageObserver* observer) {
  if (paper_) return drawn_ ? measure_found_labels(seed) : paper_->measure({input(0), input(1)}, seed);
  if (drawn_) return tray_->estimate(seed, observer);
  tray_->reset();
  for (std::size_t i = 0; i < 2; ++i) {
    // estimate() reports the failure of a view, too.
    if (!tray_->add_view(input(i)).ok()) break;
  }
  return tray_->estimate(seed, observer);
}

const Measurement& CaptureSession::measure_found_labels(std::uint64_t seed) {
  const Segmentation& found = drawn_->segmentation;
  measurement_ = {};
  measurement_.status = found.status;
  if (found.status.ok()) {
    measurement_ = paper_->measure({input(0), input(1)}, seed);
    warn_about_labels(found, measurement_.warnings);
    measurement_.status = blame_card(found, measurement_.status);
  }
  measurement_.segmentation_ms = found.total_ms();
  measurement_.total_ms += measurement_.segmentation_ms;
  return measurement_;
}

std::size_t CaptureSession::reserved_bytes() const {
  return (tray_ ? tray_->reserved_bytes() : 0) + (paper_ ? paper_->reserved_bytes() : 0);
}

std::size_t CaptureSession::used_bytes() const {
  return (tray_ ? tray_->used_bytes() : 0) + (paper_ ? paper_->used_bytes() : 0);
}

}  // namespace traygauge
