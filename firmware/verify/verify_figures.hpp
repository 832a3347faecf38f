// What the scans of an acceptance test say. Percentages; what is not defined is NaN.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware/evaluate/bootstrap.hpp"
#include "firmware/evaluate/statistics.hpp"
#include "firmware/verify/verify_record.hpp"

namespace traygauge {

// A value with its 95 % interval. `wide` adds to both ends what the bodies' own volumes are uncertain by, two
// standard deviations; where that has no influence, it is the same.
struct VerifyFigure {
  double value = kUndefined;
  std::optional<ConfidenceInterval> interval;
  std::optional<ConfidenceInterval> wide;
};

// Repeats count for `cv` and the refusals alone.
struct BodyFigures {
  VerifyBody body;
  int scans = 0;              // measured, without repeats
  VerifyFigure bias;          // mean signed error
  VerifyFigure mape;          // mean absolute error
  VerifyFigure within_one;    // share of scans whose volume lies within one sigma of the body's
  VerifyFigure within_two;    // two sigma; sigma is the scan's and the body's together
  double worst = kUndefined;  // signed error with the largest absolute value
  int warned = 0;             // of the scans
};

struct VerifyFigures {
  std::vector<BodyFigures> bodies;
  int steps = 0;
  int steps_done = 0;     // measured or given up
  int steps_refused = 0;  // given up
  int attempts = 0;
  int attempts_refused = 0;
  int repeats = 0;  // measured
  // Over all: the mean over the bodies, each with the same weight.
  VerifyFigure bias;
  VerifyFigure mape;
  VerifyFigure cv;  // of the repeats
  VerifyFigure within_one;
  VerifyFigure within_two;
  VerifyFigure refused;  // of all attempts
  // The body whose bias lies farthest from 0, its interval included; null: no body has an interval.
  const BodyFigures* worst_body() const;

  bool is_complete() const { return steps_done == steps; }
};

VerifyFigures verify_figures(const VerifyRecord& record);

// In per cent of the body's volume.
double verify_error(const VerifyScan& scan, const VerifyBody& body);

// How far from 0 an interval reaches.
double farthest(const ConfidenceInterval& interval);

}  // namespace traygauge
