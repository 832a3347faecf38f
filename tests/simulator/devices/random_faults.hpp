// Fault scripts drawn at random, as the text of a file.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "simulator/devices/fault.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {

inline std::vector<SimulatedDevice> all_simulated_devices() {
  using enum SimulatedDevice;
  return {camera, button, arm, lamp, clock};
}

// What a kind is played with where nothing else is said.
inline double usual_amount(FaultKind kind) {
  switch (kind) {
    case FaultKind::late:
      return 700.0;
    case FaultKind::mixed:
      return -0.5;
    case FaultKind::wrong_size:
      return 0.5;
    case FaultKind::bounce:
      return 20.0;
    case FaultKind::wrong_angle:
      return 4.0;
    case FaultKind::slow:
      return 3.0;
    default:
      return 0.0;
  }
}

// One [[fault]] of a script, without when and how often.
inline std::string fault_text(SimulatedDevice device, FaultKind kind, double amount) {
  std::ostringstream text;
  text << "[[fault]]\ndevice = \"" << name(device) << "\"\nwhat = \"" << name(kind) << "\"\n";
  if (const FaultAmount* what = amount_of(kind)) text << what->key << " = " << amount << "\n";
  return text.str();
}

// Up to five faults, each of which ends some time.
inline std::string random_fault_script(unsigned seed, const std::vector<SimulatedDevice>& devices) {
  std::mt19937 random(seed);
  const auto below = [&random](unsigned bound) { return static_cast<int>(random() % bound); };
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  std::ostringstream text;
  text << "seed = " << seed << "\n";
  for (int count = 1 + below(5); count > 0; --count) {
    const auto device = devices[static_cast<std::size_t>(below(static_cast<unsigned>(devices.size())))];
    const auto kinds = kinds_of(device);
    const auto kind = kinds[static_cast<std::size_t>(below(static_cast<unsigned>(kinds.size())))];
    double amount = usual_amount(kind);
    if (kind == FaultKind::late) amount = std::exp(between(0.0, std::log(20'000.0)));
    if (kind == FaultKind::mixed) amount = between(0.05, 0.95) * (below(2) == 0 ? 1.0 : -1.0);
    if (kind == FaultKind::wrong_size) amount = between(0.05, 0.95);
    if (kind == FaultKind::bounce) amount = 2 + below(60);
    if (kind == FaultKind::wrong_angle) amount = between(-25.0, 25.0);
    if (kind == FaultKind::slow) amount = between(1.0, 40.0);
    text << fault_text(device, kind, amount);
    if (below(2) == 0) {
      text << "after_calls = " << below(12) << "\n";
    } else {
      text << "after_s = " << between(0.0, 20.0) << "\n";
    }
    if (below(3) == 0) text << "share = " << between(0.2, 0.9) << "\n";
    text << "times = " << 1 + below(8) << "\n";
  }
  return text.str();
}

// A file of its own that is gone with the object.
class FaultFile {
 public:
  explicit FaultFile(const std::string& text) { std::ofstream(path()) << text; }
  std::filesystem::path path() const { return folder_.path() / "faults.toml"; }

 private:
  TemporaryFolder folder_;
};

}  // namespace traygauge
