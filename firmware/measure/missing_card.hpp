// Why a card was not found: another one lies there.
#pragma once

#include <string>

#include "core/base/status.hpp"

namespace traygauge {

class CaptureSession;

// Where the status is card_not_found and one of our other cards lies in a view of the session: a space and a
// sentence that says which, to follow that of the status. Else nothing, at no cost.
std::string explain_missing_card(StatusCode status, const CaptureSession& session);

}  // namespace traygauge
