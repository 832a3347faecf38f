// What the hub told of the next tray, as long as it holds.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/station/tray_hint.hpp"

namespace traygauge {

struct ToldTray {
  TrayHint hint;
  std::chrono::milliseconds valid_for{0};  // zero: what was told before is taken back
};

// {"tray","foods","dishes","valid_ms"} as the hub sends it; fails, with the key and what was expected.
Expected<ToldTray> read_told_tray(const std::string& text, const std::vector<std::string>& dish_styles);
std::string told_tray_json(const ToldTray& told);

// Used by one thread.
class NextTray {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Takes the place of what was told before.
  void tell(const ToldTray& told, Time now);
  // For a press at this time; what it gives is in use until use_ended().
  TrayHint use(Time now);
  // The scan that used it has a volume, and the next press is another tray's; or it has none, and the next
  // press is a second try. What was told since use() stays in either case.
  void use_ended(bool is_measured);
  // What a press at this time would use, and for how long it still holds.
  std::optional<ToldTray> at(Time now) const;

 private:
  std::optional<TrayHint> hint_;
  Time valid_until_;
  bool is_in_use_ = false;
};

}  // namespace traygauge
