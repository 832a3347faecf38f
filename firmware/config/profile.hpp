// The profiles that `--profile` names, and the parameters of each.
#pragma once

#include <cstdint>
#include <string>

#include "core/paper/pipeline/configuration.hpp"
#include "core/pipeline/configuration.hpp"

namespace traygauge {

enum class Profile : std::uint8_t {
  best,   // the product
  paper,  // each stage as the paper describes it
};

const char* name(Profile profile);

// The profile that is meant; `typed` may be empty: best. UsageError unless this program has it.
Profile choose_profile(const std::string& typed);

// Of the stages; what a tray looks like is filled in when one is measured.
struct ProfileParameters {
  Profile profile = Profile::best;
  Configuration best;          // of the product; with profile paper, of finding labels
  paper::Configuration paper;  // read by profile paper alone
};

}  // namespace traygauge
