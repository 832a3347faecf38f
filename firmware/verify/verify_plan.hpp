// The protocol of an acceptance test: which body lies where, turned how, and how often.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace traygauge {

struct VerifyBody {
  std::string id;
  std::string proof;   // the id of a folded one; empty: the tester's own body
  std::string origin;  // how its volume is known, for people
  double volume_ml = 0.0;
  double volume_sigma_ml = 0.0;
};

struct VerifyPlace {
  std::string name;
  std::array<double, 2>
      shift_mm{};  // of the dish from the middle of the tray: to the right, away from the front
};

// One scan that is wanted.
struct VerifyStep {
  std::string id;
  std::size_t body = 0;
  std::size_t place = 0;
  double angle_deg = 0.0;  // of the body's length from left-right, counter-clockwise from above
  bool is_repeat = false;  // for the repeatability alone
};

struct VerifyPlan {
  std::string name;
  std::string dish;  // the style of what the bodies stand on
  int attempts = 3;  // of a scan that is refused
  std::vector<VerifyBody> bodies;
  std::vector<VerifyPlace> places;
  std::vector<VerifyStep> steps;  // in the order in which they are done
};

// How well a folded body has the drawn lengths, and how well a caliper says them, mm (standard deviations).
inline constexpr double kFoldedSigmaMm = 0.3;
inline constexpr double kCaliperSigmaMm = 0.1;

// Throws InputError; keys that are not known are errors.
VerifyPlan read_verify_plan(const std::filesystem::path& file);

// The default plan as TOML with comments: every proof body at three places and two angles, ten repeats of
// one.
std::string compose_default_plan(const std::string& dish, double folded_sigma_mm);

}  // namespace traygauge
