// What a profile can measure, where that decides what `evaluate` does.
#pragma once

#include <array>
#include <string>

namespace traygauge {

struct ProfileAbilities {
  const char* name = "";
  bool measures_several_dishes = false;  // on one tray
  bool takes_dish_for_flat = false;      // measures what lies above the plane of the dish's bottom
};

// The first is the default.
inline constexpr std::array kProfileAbilities = {
    ProfileAbilities{"paper", false, true},
};

// Of a profile that check_profile() accepts; empty: the default.
inline const ProfileAbilities& abilities_of(const std::string& profile) {
  for (const ProfileAbilities& abilities : kProfileAbilities) {
    if (abilities.name == profile) return abilities;
  }
  return kProfileAbilities.front();
}

}  // namespace traygauge
