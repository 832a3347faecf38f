#include "core/estimator/best/best_view.hpp"

#include "core/estimator/view_input.hpp"
#include "core/image/exposure.hpp"
#include "core/image/resample.hpp"

namespace traygauge {

Status prepare_best_view(const FrameView& frame, const Configuration& configuration,
                         const CardPattern& pattern, BestViewWorkspace& workspace, StageClock& clock,
                         BestView& view) {
  clock.enter(Stage::image);
  if (const Status status = measure_labels(frame, configuration, view); !status.ok()) return status;
  if (const Status status = check_labels(view.regions); !status.ok()) return status;
  return prepare_labelled_view(frame, configuration, pattern, workspace, clock, view);
}

Status measure_labels(const FrameView& frame, const Configuration& configuration, BestView& view) {
  if (const Status status = check_sizes(frame, view.labels, view.lens, configuration.limits); !status.ok()) {
    return status;
  }
  view.regions = measure_regions(view.labels);
  return StatusCode::ok;
}

Status prepare_labelled_view(const FrameView& frame, const Configuration& configuration,
                             const CardPattern& pattern, BestViewWorkspace& workspace, StageClock& clock,
                             BestView& view) {
  clock.enter(Stage::image);
  view.frame = frame;
  const ImageView<std::uint8_t> gray{view.gray_storage.data, frame.width, frame.height};
  convert_to_gray(frame, gray);
  if (const Status status = check_exposure(gray, configuration.exposure); !status.ok()) return status;
  const CheckedView checked{frame, gray, view.labels, &view.regions, &view.lens};
  assess_view(checked, {configuration.card.width_mm, configuration.card.height_mm}, configuration.view_checks,
              workspace.silhouette, view.quality_storage.front());
  if (const Status status = judge_view(view.quality(), configuration.view_checks); !status.ok())
    return status;
  view.gray = build_pyramid(gray, view.pyramid);

  clock.enter(Stage::scale);
  return align_card(gray, view.labels, view.regions.card, view.lens, pattern, configuration.best.card,
                    workspace.card, view.card_storage.front());
}

}  // namespace traygauge
