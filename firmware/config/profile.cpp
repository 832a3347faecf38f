#include "firmware/config/profile.hpp"

#include "core/base/status.hpp"
#include "core/features/has_surf.hpp"
#include "firmware/base/exit_status.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
const char* name(Profile profile) {
  return profile == Profile::paper ? "paper" : "best";
}

Profile choose_profile(const std::string& typed) {
  if (typed.empty() || typed == name(Profile::best)) return Profile::best;
  if (typed != name(Profile::paper)) {
    throw UsageError("--profile: expected best or paper, found " + printable(typed));
  }
  if (!has_surf()) {
    throw UsageError(std::string("--profile paper: ") + sentence(StatusCode::surf_not_built));
  }
  return Profile::paper;
}

}  // namespace traygauge
