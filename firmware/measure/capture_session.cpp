#include "firmware/measure/capture_session.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "firmware/measure/label_list.hpp"

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

bool same_lens(const LensModel& a, const LensModel& b) {
  return a.width == b.width && a.height == b.height && a.pinhole.fx_px == b.pinhole.fx_px &&
         a.pinhole.fy_px == b.pinhole.fy_px && a.pinhole.cx_px == b.pinhole.cx_px &&
         a.pinhole.cy_px == b.pinhole.cy_px && a.k1 == b.k1 && a.k2 == b.k2 && a.p1 == b.p1 && a.p2 == b.p2 &&
         a.k3 == b.k3;
}

}  // namespace

CaptureSession::CaptureSession(const Capture& capture, std::array<int, 2> pair,
                               const std::vector<DishDescription>& dishes, const Configuration& parameters,
                               LabelSource labels)
    : descriptions_{view_of(capture, pair[0]), view_of(capture, pair[1])},
      views_{load_view(*descriptions_[0]), load_view(*descriptions_[1])},
      setup_(set_up_pair(capture, pair, dishes)),
      configuration_(configure(setup_, parameters)),
      block_(required_bytes(configuration_)),
      estimator_(block_.bytes(), configuration_) {
  check_inputs(capture);
  if (labels == LabelSource::automatic) draw_labels();
}

void CaptureSession::draw_labels() {
  drawer_.emplace(configuration_);
  drawer_->configure(configuration_, estimator_);
  // measure() reports the failure of a view, too; its labels stay empty.
  for (std::size_t i = 0; i < 2; ++i) static_cast<void>(drawer_->add_view(input(i), estimator_));
  for (std::size_t i = 0; i < 2; ++i) {
    given_labels_[i] = std::move(views_[i].labels);
    views_[i].labels = drawer_->drawn().labels[i];
  }
}

void CaptureSession::check_inputs(const Capture& capture) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (!validate(setup_.lenses[i]).ok()) {
      throw InputError({capture.file, descriptions_[i]->camera_key + ".distortion"},
                       "coefficients that hold up to the corners of the picture", "a lens that folds it over",
                       "calibrate the camera again, with corners near the edge of the picture");
    }
    const std::string unknown = list_labels(views_[i].labels, is_meaningless);
    if (!unknown.empty()) {
      warnings_.push_back({"labels_without_meaning", printable(descriptions_[i]->labels->path.string()) +
                                                         ": labels without a meaning (" + unknown +
                                                         ") count as background."});
    }
  }
  if (!estimator_.status().ok()) {
    throw InputError({capture.file, ""}, "a plausible camera, card and dish",
                     "values that contradict each other", sentence(estimator_.status().code()));
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
  if (!same_lens(setup_.lenses[i], setup_.lenses[0])) input.lens = setup_.lenses[i];
  input.arm_angle_deg = descriptions_[i]->arm_angle_deg;
  return input;
}

const Measurement& CaptureSession::measure(std::uint64_t seed, StageTap* tap) {
  if (drawer_) return drawer_->measure(estimator_, seed, tap);
  estimator_.reset();
  for (std::size_t i = 0; i < 2; ++i) {
    // estimate() reports the failure of a view, too.
    if (!estimator_.add_view(input(i)).ok()) break;
  }
  return estimator_.estimate(seed, tap);
}

}  // namespace traygauge
