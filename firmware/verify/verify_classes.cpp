#include "firmware/verify/verify_classes.hpp"

#include <algorithm>

#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

std::string percent_text(double value) {
  return fixed(value, 1) + " %";
}

// Whether the test is whole and large enough.
void check_extent(const VerifyFigures& figures, std::vector<std::string>& faults) {
  if (!figures.is_complete()) {
    faults.push_back("The test is not finished: " + std::to_string(figures.steps_done) + " of " +
                     std::to_string(figures.steps) + " steps are done.");
  }
  if (figures.bodies.size() < kMinBodies) {
    faults.push_back("The plan has " + std::to_string(figures.bodies.size()) + " bodies; a class needs " +
                     std::to_string(kMinBodies) + ".");
  }
  for (const BodyFigures& own : figures.bodies) {
    if (own.scans >= kMinScansOfBody) continue;
    faults.push_back("Body " + own.body.id + " was measured " + std::to_string(own.scans) +
                     " times; a class needs " + std::to_string(kMinScansOfBody) + ".");
  }
  if (figures.repeats < kMinRepeats) {
    faults.push_back(std::to_string(figures.repeats) + " repeats were measured; a class needs " +
                     std::to_string(kMinRepeats) + ".");
  }
}

void check_most(const std::string& what, double bound, double limit, std::vector<std::string>& faults) {
  if (bound <= limit) return;
  faults.push_back(what + " may reach " + percent_text(bound) + "; the class allows " + percent_text(limit) +
                   ".");
}

}  // namespace

const VerifyClass* find_verify_class(std::string_view name) {
  const auto* const found = std::ranges::find_if(
      kVerifyClasses, [&](const VerifyClass& own) { return name == std::string_view(&own.name, 1); });
  return found == kVerifyClasses.end() ? nullptr : found;
}

std::vector<std::string> find_shortcomings(const VerifyFigures& figures, const VerifyClass& wanted) {
  std::vector<std::string> faults;
  check_extent(figures, faults);
  if (!faults.empty()) return faults;
  // Enough scans of each body: all intervals are there.
  check_most("The bias over all bodies", farthest(*figures.bias.wide), wanted.bias, faults);
  for (const BodyFigures& own : figures.bodies)
    check_most("The bias of body " + own.body.id, farthest(*own.bias.wide), wanted.body_bias, faults);
  check_most("The MAPE", figures.mape.wide->high, wanted.mape, faults);
  check_most("The CV of the repeats", figures.cv.wide->high, wanted.cv, faults);
  if (figures.within_two.wide->low < wanted.within_two) {
    faults.push_back("Within two sigma may lie as few as " + percent_text(figures.within_two.wide->low) +
                     " of the volumes; the class asks for " + percent_text(wanted.within_two) + ".");
  }
  check_most("The share of refusals", figures.refused.wide->high, wanted.refused, faults);
  return faults;
}

const VerifyClass* best_class(const VerifyFigures& figures) {
  const auto* const best = std::ranges::find_if(
      kVerifyClasses, [&](const VerifyClass& wanted) { return find_shortcomings(figures, wanted).empty(); });
  return best == kVerifyClasses.end() ? nullptr : best;
}

}  // namespace traygauge
