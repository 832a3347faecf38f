#include "firmware/config/profile.hpp"

#include "firmware/base/exit_status.hpp"
#include "firmware/paper/paper_profile.hpp"
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
  if (!has_paper_profile()) {
    throw UsageError(
        "--profile paper: this program was built without it; use best, or build with -DTRAYGAUGE_PAPER=ON");
  }
  return Profile::paper;
}

}  // namespace traygauge
