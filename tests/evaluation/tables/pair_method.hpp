// A variant at work on one pair of a capture.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "firmware/evaluate/protocol.hpp"
#include "tests/evaluation/tables/variant.hpp"

namespace traygauge::tables {

class PairMethod {
 public:
  virtual ~PairMethod() = default;
  // The same seed gives the same volumes.
  virtual Run measure(std::uint64_t seed) = 0;
};

// Loads the pictures. `config`: folder with dishes/, for captures that name none. Throws InputError.
std::unique_ptr<PairMethod> open_pair(const PairTask& task, const Variant& variant,
                                      const std::string& config);

}  // namespace traygauge::tables
