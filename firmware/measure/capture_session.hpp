// One pair of a capture through one estimator.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/estimator/estimator.hpp"
#include "firmware/base/aligned_block.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

LensModel lens_of(const CameraDescription& camera);
DishModel dish_of(const DishDescription& dish);

// Caps for frames of these sizes, everything else at its default.
EstimatorLimits limits_for(PictureSize first, PictureSize second);

// Loads the pictures of the pair and builds the estimator for them; both live as long as the session. Throws
// InputError.
class CaptureSession {
 public:
  // `dishes`: the dish, or candidates for it.
  // `parameters` carries those of the stages; its camera, card and dishes are replaced by the capture's.
  CaptureSession(const Capture& capture, std::array<int, 2> pair, const std::vector<DishDescription>& dishes,
                 const Configuration& parameters = {});

  // The views of `measurement` point into the session.
  const Measurement& measure(std::uint64_t seed);

  const Estimator& estimator() const { return estimator_; }
  const LoadedView& view(int i) const { return views_[static_cast<std::size_t>(i)]; }
  const LensModel& lens(int i) const { return lenses_[static_cast<std::size_t>(i)]; }
  // Doubts about the input that do not stop a measurement.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  Configuration configure(const Configuration& parameters) const;
  ViewInput input(std::size_t i) const;
  void check_inputs(const Capture& capture);

  std::array<const ViewDescription*, 2> descriptions_{};
  std::array<LensModel, 2> lenses_;
  std::array<LoadedView, 2> views_;
  Picture pattern_;
  CardDescription card_;
  std::vector<DishModel> dishes_;
  std::vector<std::string> warnings_;
  Configuration configuration_;
  AlignedBlock block_;
  Estimator estimator_;
};

}  // namespace traygauge
