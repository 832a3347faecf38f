#include "firmware/config/profile.hpp"

#include "core/base/status.hpp"
#include "core/features/has_surf.hpp"
#include "firmware/base/exit_status.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

constexpr const char* kPaper = "paper";

}  // namespace

std::string choose_profile(const std::string& typed) {
  if (typed == "best") {
    throw UsageError("--profile best is not part of this version; use --profile paper, which is the default");
  }
  if (!typed.empty() && typed != kPaper)
    throw UsageError("--profile: expected paper, found " + printable(typed));
  if (!has_surf()) {
    throw UsageError(std::string("--profile paper: ") + sentence(StatusCode::surf_not_built));
  }
  return kPaper;
}

}  // namespace traygauge
