#include "firmware/paper/paper_profile.hpp"

#include "core/paper/pipeline/estimator.hpp"
#include "firmware/base/aligned_block.hpp"

namespace traygauge {
namespace {

class OwnedEstimator final : public PaperEstimator {
 public:
  explicit OwnedEstimator(const paper::Configuration& configuration)
      : block_(paper::required_bytes(configuration)), estimator_(block_.bytes(), configuration) {}

  const Measurement& measure(const std::array<ViewInput, 2>& views, std::uint64_t seed) override {
    estimator_.reset();
    for (const ViewInput& view : views) {
      // estimate() reports the failure of a view, too.
      if (!estimator_.add_view(view).ok()) break;
    }
    return estimator_.estimate(seed);
  }
  const paper::WorkingPictures& pictures() const override { return estimator_.pictures(); }
  paper::Estimator& estimator() override { return estimator_; }
  Status status() const override { return estimator_.status(); }
  double setup_ms() const override { return estimator_.setup_ms(); }
  std::size_t reserved_bytes() const override { return estimator_.reserved_bytes(); }
  std::size_t used_bytes() const override { return estimator_.used_bytes(); }

 private:
  AlignedBlock block_;
  paper::Estimator estimator_;
};

}  // namespace

bool has_paper_profile() {
  return true;
}

std::unique_ptr<PaperEstimator> open_paper_estimator(const paper::Configuration& configuration) {
  return std::make_unique<OwnedEstimator>(configuration);
}

std::vector<MemoryRow> describe_paper_memory(const paper::Configuration& configuration) {
  const auto rows = paper::describe_memory(configuration);
  return {rows.begin(), rows.end()};
}

std::size_t paper_bytes(const paper::Configuration& configuration) {
  return paper::required_bytes(configuration);
}

}  // namespace traygauge
