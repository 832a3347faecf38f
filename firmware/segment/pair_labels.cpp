#include "firmware/segment/pair_labels.hpp"

#include "firmware/measure/measure_report.hpp"

namespace traygauge {
namespace {

PictureSize largest_frame(const Configuration& configuration) {
  return {configuration.limits.max_frame_width, configuration.limits.max_frame_height};
}

// Within the memory that the picture has.
ImageView<std::uint8_t> resized(Picture& picture, PictureSize size) {
  picture.size = size;
  picture.pixels.resize(Picture::area(size));
  return {picture.pixels.data(), size.width, size.height};
}

bool fits(PictureSize size, const Picture& picture) {
  return Picture::area(size) <= picture.pixels.capacity();
}

void warn_about_labels(const Segmentation& segmentation, WarningSet& warnings) {
  for (const SegmentedDish& dish : std::span(segmentation.dishes).first(segmentation.dish_count)) {
    warnings.raise_if(!dish.status.ok(), Warning::dish_not_found, dish.label);
    warnings.raise_if(dish.is_split_doubtful, Warning::items_doubtful, dish.label);
  }
  warnings.raise_if(segmentation.misses_hint, Warning::items_doubtful);
}

}  // namespace

LabelDrawer::LabelDrawer(const Configuration& configuration) {
  drawn_.working_bytes = segmenter_bytes(configuration);
  for (Picture& labels : drawn_.labels) labels = Picture(largest_frame(configuration), PixelFormat::gray8);
  if (configuration.profile == Profile::best) return;
  block_.emplace(drawn_.working_bytes);
  for (Picture& gray : gray_) gray = Picture(largest_frame(configuration), PixelFormat::gray8);
  ArenaPlan plan;
  pattern_.allocate(plan, configuration.best.card.pattern);
  pattern_block_.emplace(plan.high_water_bytes());
}

void LabelDrawer::take_memory(const Estimator& estimator) {
  const std::span<std::byte> lent = estimator.idle_memory();
  const bool borrows = !block_ && lent.size() >= drawn_.working_bytes;
  if (!borrows && !block_) block_.emplace(drawn_.working_bytes);
  memory_ = borrows ? lent.first(drawn_.working_bytes) : block_->bytes();
  drawn_.reserved_bytes = borrows ? 0 : block_->bytes().size();
}

void LabelDrawer::configure(const Configuration& configuration, const Estimator& estimator) {
  configuration_ = configuration;
  learned_ = estimator.card_pattern();
  if (learned_ == nullptr && pattern_block_) {
    Arena arena(pattern_block_->bytes());
    pattern_.allocate(arena, configuration.best.card.pattern);
    const ReferenceCard& card = configuration.card;
    if (prepare_card_pattern(card.pattern, card.size(), configuration.best.card.pattern, pattern_).ok())
      learned_ = &pattern_;
  }
  if (learned_ != nullptr) take_memory(estimator);
  reset();
}

// What the segmenter had learned lay where the stages have worked since.
void LabelDrawer::reset() {
  view_count_ = 0;
  drawn_.segmentation = {};
  segmenter_.reset();
  if (learned_ != nullptr) segmenter_.emplace(memory_, configuration_, *learned_);
}

Status LabelDrawer::add_view(const ViewInput& view, const Estimator& estimator) {
  if (!segmenter_ || view_count_ == views_.size()) return StatusCode::wrong_call;
  const std::size_t index = view_count_++;
  const PictureSize size{view.frame.width, view.frame.height};
  SegmentedView segmented;
  segmented.frame = view.frame;
  segmented.lens = view.lens;
  if (fits(size, drawn_.labels[index])) {
    segmented.labels = resized(drawn_.labels[index], size);
    const ImageView<std::uint8_t> kept = estimator.gray_memory(index);
    segmented.gray = kept.empty() ? resized(gray_[index], size)
                                  : ImageView<std::uint8_t>{kept.data, size.width, size.height};
  }
  const Status status = segmenter_->add_view(segmented);
  views_[index] = view;
  views_[index].labels = segmented.labels;
  views_[index].gray = segmented.gray;
  views_[index].card = &segmenter_->card(index);
  views_[index].are_outlines_found = true;
  if (view_count_ < views_.size()) return status;
  drawn_.segmentation = segmenter_->segment();
  return drawn_.segmentation.status;
}

const Measurement& LabelDrawer::measure(Estimator& estimator, std::uint64_t seed, StageTap* tap) {
  // After one view only: what it lacks, or that the other is missing.
  if (segmenter_ && view_count_ < views_.size()) drawn_.segmentation = segmenter_->segment();
  const Segmentation& segmentation = drawn_.segmentation;
  measurement_ = {};
  measurement_.status = segmenter_ ? segmentation.status : Status(StatusCode::invalid_configuration);
  if (measurement_.status.ok()) {
    estimator.reset();
    for (const ViewInput& view : views_) {
      // estimate() reports the failure of a view, too.
      if (!estimator.add_view(view).ok()) break;
    }
    measurement_ = estimator.estimate(seed, tap);
    warn_about_labels(segmentation, measurement_.warnings);
    if (segmentation.is_card_doubtful) {
      measurement_.warnings.raise(Warning::card_partly_hidden);
      // Outlines that were drawn after a card out of its place contradict each other; nobody else is to
      // blame.
      if (!is_measured(measurement_)) measurement_.status = StatusCode::card_hidden;
    }
  }
  measurement_.segmentation_ms = segmentation.total_ms();
  measurement_.total_ms += measurement_.segmentation_ms;
  return measurement_;
}

}  // namespace traygauge
