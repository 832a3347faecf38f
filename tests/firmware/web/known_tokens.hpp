// Tokens that tests write into files.
#pragma once

#include <string>

namespace traygauge::test {

inline const std::string kViewToken = "view-token-0123456789";
inline const std::string kKioskToken = "kiosk-token-0123456789";
inline const std::string kManageToken = "manage-token-0123456789";

}  // namespace traygauge::test
