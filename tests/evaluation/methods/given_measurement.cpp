#include "tests/evaluation/methods/given_measurement.hpp"

#include "core/paper/pipeline/estimator.hpp"

namespace traygauge::tables {

const Measurement& measure_given(CaptureSession& session, const PairMatches& matches, std::uint64_t seed) {
  paper::Estimator& estimator = session.paper_estimator();
  estimator.reset();
  Status status;
  for (std::size_t i = 0; i < 2 && status.ok(); ++i)
    status = estimator.add_view_without_features(session.input(i));
  // What fails here is reported by estimate(): a view's fault, or too few matches.
  if (status.ok()) status = estimator.set_matches(matches.matches, matches.card_matches);
  static_cast<void>(status);
  return estimator.estimate(seed);
}

}  // namespace traygauge::tables
