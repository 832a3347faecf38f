// What a measurement of a capture says, for the table, the document and the picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/paper/pipeline/working_pictures.hpp"
#include "core/pipeline/measurement.hpp"

namespace traygauge {

// A doubt as the contract's documents carry it.
struct ReportedWarning {
  std::string code;                       // e.g. "angle_small"
  std::string message;                    // a sentence
  std::uint8_t label = kBackgroundLabel;  // of the item or dish that it is about, if one
};

struct MeasureReport {
  std::string capture;  // as named by the caller
  std::array<int, 2> pair{};
  std::string profile;
  std::uint64_t seed = 0;
  std::string message;
  const Measurement* measurement = nullptr;          // outlives the report
  const paper::WorkingPictures* pictures = nullptr;  // of profile paper; outlive it, too
  double setup_ms = 0.0;
  std::optional<double> segmentation_ms;  // where the labels were drawn by it; part of the total
  std::size_t reserved_bytes = 0;
  std::size_t used_bytes = 0;
  std::vector<ReportedWarning> warnings;
};

// The sentence of the status with what a person needs to act on it.
std::string compose_message(const Measurement& measurement);

// The doubts of the input, then those of the measurement.
std::vector<ReportedWarning> list_warnings(const Measurement& measurement,
                                           const std::vector<ReportedWarning>& input);

// For people, with the item or dish that it is about.
std::string describe(const ReportedWarning& warning);

// The JSON document of the contract, on one line; what was not measured is null.
std::string compose_document(const MeasureReport& report);

// The same for people.
std::string compose_table(const MeasureReport& report);

}  // namespace traygauge
