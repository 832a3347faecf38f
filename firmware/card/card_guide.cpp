#include "firmware/card/card_guide.hpp"

namespace traygauge {
namespace {

// Where the optical axis meets the table. A card that is seen is not seen edge on.
Vec3 aim_of(const Pose& camera_from_table) {
  const Vec3 axis = camera_from_table.rotation.row(2);
  const Vec3 centre = camera_centre_mm(camera_from_table);
  return centre - axis * (centre.z() / axis.z());
}

}  // namespace

void CardGuide::take_memory(const LensModel& lens, std::span<std::byte> lent) {
  if (lent.size() >= CardFinder::required_bytes(lens.width, lens.height)) {
    finder_.emplace(lent, lens.width, lens.height);
    owns_memory_ = false;
  } else if (!owns_memory_ || lens.width != lens_.width || lens.height != lens_.height) {
    finder_.emplace(lens.width, lens.height);
    owns_memory_ = true;
  }
}

void CardGuide::begin(const ReferenceCard& card, const LensModel& lens, const FrameView& first,
                      std::span<std::byte> lent) {
  take_memory(lens, lent);
  lens_ = lens;
  first_.reset();
  CardAlignment found;
  if (!finder_->learn(card).ok() || !finder_->find(first, lens_, found).ok()) return;
  first_ = found.camera_from_table;
  aim_mm_ = aim_of(*first_);
}

std::optional<double> CardGuide::turned_deg(const FrameView& live) {
  CardAlignment found;
  if (!first_ || !finder_->find(live, lens_, found).ok()) return std::nullopt;
  return angle_between_views_deg({*first_, found.camera_from_table}, aim_mm_);
}

}  // namespace traygauge
