#include "firmware/paper/paper_profile.hpp"

namespace traygauge {

bool has_paper_profile() {
  return false;
}

std::unique_ptr<PaperEstimator> open_paper_estimator(const paper::Configuration& /*configuration*/) {
  return nullptr;
}

std::vector<MemoryRow> describe_paper_memory(const paper::Configuration& /*configuration*/) {
  return {};
}

std::size_t paper_bytes(const paper::Configuration& /*configuration*/) {
  return 0;
}

}  // namespace traygauge
