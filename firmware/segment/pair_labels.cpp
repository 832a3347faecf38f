#include "firmware/segment/pair_labels.hpp"

#include <memory>

#include "firmware/base/aligned_block.hpp"

namespace traygauge {

PairLabels label_pair(const Configuration& configuration, const PairSetup& setup,
                      const std::array<LoadedView, 2>& views) {
  PairLabels result;
  result.reserved_bytes = segmenter_bytes(configuration);
  AlignedBlock block(result.reserved_bytes);
  const auto segmenter = std::make_unique<Segmenter>(block.bytes(), configuration);
  std::array<SegmentedView, 2> segmented;
  for (std::size_t i = 0; i < 2; ++i) {
    Picture& labels = result.labels[i];
    labels = Picture(views[i].picture.size, PixelFormat::gray8);
    segmented[i].frame = views[i].picture.frame();
    segmented[i].labels = {labels.pixels.data(), labels.size.width, labels.size.height};
    segmented[i].lens = setup.lenses[i];
  }
  result.segmentation = segmenter->segment(segmented);
  return result;
}

}  // namespace traygauge
