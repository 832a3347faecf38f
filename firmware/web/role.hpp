// What somebody may do.
#pragma once

#include <cstdint>
#include <string_view>

namespace traygauge {

// Each may do what those before it may. A kiosk sees what view sees; its login does not end.
enum class Role : std::uint8_t { none, view, kiosk, manage };

constexpr std::string_view role_name(Role role) {
  switch (role) {
    case Role::view:
      return "view";
    case Role::kiosk:
      return "kiosk";
    case Role::manage:
      return "manage";
    case Role::none:
      break;
  }
  return "none";
}

// A kiosk is a view whose login lasts.
constexpr bool is_enough(Role role, Role minimum) {
  const bool both_view = minimum == Role::kiosk && role == Role::view;
  return role >= minimum || both_view;
}

}  // namespace traygauge
