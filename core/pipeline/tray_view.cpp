#include "core/pipeline/tray_view.hpp"

#include "core/image/resample.hpp"
#include "core/quality/exposure.hpp"
#include "core/quality/view_input.hpp"

namespace traygauge {

Status prepare_tray_view(const GivenPicture& picture, const Configuration& configuration,
                         const CardPattern& pattern, TrayViewWorkspace& workspace, StageClock& clock,
                         TrayView& view) {
  clock.enter(Stage::image);
  if (const Status status = measure_labels(picture.frame, configuration, view); !status.ok()) return status;
  if (const Status status = check_labels(view.regions()); !status.ok()) return status;
  return prepare_labelled_view(picture, configuration, pattern, workspace, clock, view);
}

Status measure_labels(const FrameView& frame, const Configuration& configuration, TrayView& view) {
  if (const Status status = check_sizes(frame, view.labels, view.lens, configuration.limits); !status.ok()) {
    return status;
  }
  view.region_storage.front() = measure_regions(view.labels);
  return StatusCode::ok;
}

Status prepare_labelled_view(const GivenPicture& picture, const Configuration& configuration,
                             const CardPattern& pattern, TrayViewWorkspace& workspace, StageClock& clock,
                             TrayView& view) {
  clock.enter(Stage::image);
  const FrameView& frame = picture.frame;
  view.frame = frame;
  ImageView<const std::uint8_t> gray = picture.gray;
  if (gray.empty()) {
    const ImageView<std::uint8_t> own{view.gray_storage.data, frame.width, frame.height};
    convert_to_gray(frame, own);
    if (const Status status = check_exposure(own, configuration.exposure); !status.ok()) return status;
    gray = own;
  }
  const CheckedView checked{frame, gray, view.labels, &view.regions(), &view.lens};
  assess_view(checked, {configuration.card.width_mm, configuration.card.height_mm}, configuration.view_checks,
              workspace.silhouette, view.quality_storage.front());
  if (const Status status = judge_view(view.quality(), configuration.view_checks); !status.ok())
    return status;
  view.gray = build_pyramid(gray, view.pyramid);

  clock.enter(Stage::scale);
  if (picture.card != nullptr) {
    view.card_storage.front() = *picture.card;
    return StatusCode::ok;
  }
  if (view.regions().card.empty()) return StatusCode::no_card_label;
  const Result<CardAlignment> aligned = align_card(gray, view.labels, view.regions().card, view.lens, pattern,
                                                   configuration.card_alignment, workspace.card);
  if (aligned.ok()) view.card_storage.front() = *aligned;
  return aligned.status();
}

}  // namespace traygauge
