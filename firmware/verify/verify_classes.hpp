// The classes that a certificate may claim.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/verify/verify_figures.hpp"

namespace traygauge {

// Limits in per cent that the 95 % intervals must keep, the uncertainty of the bodies included.
struct VerifyClass {
  char name = 'C';
  std::string_view use;
  double bias = 0.0;       // of all bodies together, to either side
  double body_bias = 0.0;  // of each body
  double mape = 0.0;
  double cv = 0.0;
  double within_two = 0.0;  // at least
  double refused = 0.0;
};

// From the strictest.
//
// A: a volume is then no longer the weak link of a nutrient value, because densities of foods vary by some 5
// %. B: two portions are told apart that differ as a ladle does from the next, 10 %. C: consumption and waste
// of a week are known; one portion is about as good as the method's paper (8 %). Coverage and refusals follow
// from the scans that half an hour allows: 28 of 30 and none of 40 have such bounds.
inline constexpr std::array<VerifyClass, 3> kVerifyClasses{
    {{'A', "portions and nutrients", 2.0, 4.0, 3.0, 1.5, 75.0, 10.0},
     {'B', "portions", 5.0, 8.0, 6.0, 3.0, 70.0, 15.0},
     {'C', "consumption and waste, in the mean", 10.0, 15.0, 12.0, 5.0, 60.0, 20.0}}};

// Null: no such class.
const VerifyClass* find_verify_class(std::string_view name);

// The least that a test has to hold for any class.
inline constexpr int kMinBodies = 4;
inline constexpr int kMinScansOfBody = 4;
inline constexpr int kMinRepeats = 10;

// Why the class is not reached, a sentence each; empty: it is.
std::vector<std::string> find_shortcomings(const VerifyFigures& figures, const VerifyClass& wanted);

// The strictest class that is reached; null: none.
const VerifyClass* best_class(const VerifyFigures& figures);

}  // namespace traygauge
