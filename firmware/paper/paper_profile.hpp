// Profile `paper`, where this program was built with it (TRAYGAUGE_PAPER).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/paper/pipeline/working_pictures.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/pipeline/memory_row.hpp"
#include "core/pipeline/view_input.hpp"

namespace traygauge {

namespace paper {
class Estimator;
struct Configuration;
}  // namespace paper

bool has_paper_profile();

// An estimator with its memory.
class PaperEstimator {
 public:
  virtual ~PaperEstimator() = default;

  // Both views with their labels. Valid until the next call.
  virtual const Measurement& measure(const std::array<ViewInput, 2>& views, std::uint64_t seed) = 0;
  virtual const paper::WorkingPictures& pictures() const = 0;
  // For measurements from points that other programs found.
  virtual paper::Estimator& estimator() = 0;

  virtual Status status() const = 0;
  virtual double setup_ms() const = 0;
  virtual std::size_t reserved_bytes() const = 0;
  virtual std::size_t used_bytes() const = 0;
};

// Null without the profile.
std::unique_ptr<PaperEstimator> open_paper_estimator(const paper::Configuration& configuration);

// Its parts and their sum; nothing without the profile.
std::vector<MemoryRow> describe_paper_memory(const paper::Configuration& configuration);
std::size_t paper_bytes(const paper::Configuration& configuration);

}  // namespace traygauge
