#include "tests/evaluation/methods/single_view.hpp"

#include <cmath>

#include "core/labels/label_regions.hpp"
#include "tests/evaluation/methods/stopwatch.hpp"

namespace traygauge::tables {
namespace {

// The estimator's checks of the picture, and its undistorted, resized labels: the view taken twice goes as
// far as that.
StatusCode prepare_first_view(CaptureSession& session, paper::WorkingPictures& pictures) {
  paper::Estimator& estimator = session.paper_estimator();
  estimator.reset();
  for (int i = 0; i < 2; ++i) {
    const Status status = estimator.add_view_without_features(session.input(0));
    if (!status.ok()) return status.code();
  }
  static_cast<void>(estimator.estimate(1));
  pictures = estimator.pictures();
  return StatusCode::ok;
}

}  // namespace

SilhouetteFit fit_prior(const ItemView& item, const ShapePriors& priors) {
  const SilhouetteFit cap = fit_silhouette(
      item, Template::cap, [&](double area_mm2) { return priors.cap_height * std::sqrt(area_mm2); });
  const SilhouetteFit box = fit_silhouette(
      item, Template::box, [&](double area_mm2) { return priors.box_height * std::sqrt(area_mm2); });
  return box.overlap > cap.overlap + priors.box_advantage ? box : cap;
}

Run measure_single_view(CaptureSession& session, std::uint64_t seed, const ShapePriors& priors) {
  Run run;
  run.seed = seed;
  const PointFeatures pattern = find_on_pattern(session, Detector::sift);
  const Stopwatch watch;
  paper::WorkingPictures pictures;
  run.status = prepare_first_view(session, pictures);
  if (run.status != StatusCode::ok) return run;
  const auto print = find_card_plane(session, 0, find_in_view(session, 0, Detector::sift), pattern);
  run.status = StatusCode::card_not_found;
  if (!print) return run;
  const auto bottom = bottom_under_print(session, *print);
  run.status = StatusCode::dish_unknown;
  if (!bottom) return run;
  const ImageView<const std::uint8_t> labels = pictures.labels[0];
  const cv::Mat picture = as_cv(labels);
  ItemView item{pictures.cameras[0], frame_on(*bottom, pictures.cameras[0], labels), {}};
  for (const std::uint8_t label : items_in(labels)) {
    item.mask = picture == label;
    run.items.push_back({label, StatusCode::ok, volume_ml(fit_prior(item, priors).solid)});
  }
  conclude(run);
  run.total_ms = watch.elapsed_ms();
  return run;
}

}  // namespace traygauge::tables
