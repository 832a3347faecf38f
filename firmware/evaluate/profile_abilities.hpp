// What a profile can measure, where that decides what `evaluate` does.
#pragma once

#include "firmware/config/profile.hpp"

namespace traygauge {

struct ProfileAbilities {
  const char* name = "";
  bool measures_several_dishes = false;  // on one tray
  bool takes_dish_for_flat = false;      // measures what lies above the plane of the dish's bottom
};

constexpr ProfileAbilities abilities_of(Profile profile) {
  return profile == Profile::paper ? ProfileAbilities{"paper", false, true}
                                   : ProfileAbilities{"best", true, false};
}

}  // namespace traygauge
