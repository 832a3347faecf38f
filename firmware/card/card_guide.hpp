// How far a hand has moved the camera, or turned the tray, since the first view: seen by the card.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "firmware/card/card_finder.hpp"

namespace traygauge {

// For one thread. Takes its memory with the first begin() that lends none.
class CardGuide {
 public:
  // The first view of a tray, and the card that lies there; the pixels are not kept. Where `lent` is large
  // enough it is worked in until the next begin().
  void begin(const ReferenceCard& card, const LensModel& lens, const FrameView& first,
             std::span<std::byte> lent = {});
  // Between the lines of sight of the first view and this one, to where the first one's picture has its
  // middle on the table, since dishes stand there; degrees. None where either does not show the card.
  std::optional<double> turned_deg(const FrameView& live);

 private:
  void take_memory(const LensModel& lens, std::span<std::byte> lent);

  std::optional<CardFinder> finder_;
  bool owns_memory_ = false;
  LensModel lens_;
  std::optional<Pose> first_;  // camera_from_table
  Vec3 aim_mm_ = Vec3::Zero();
};

}  // namespace traygauge
