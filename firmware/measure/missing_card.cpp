#include "firmware/measure/missing_card.hpp"

#include <array>
#include <optional>

#include "firmware/card/known_cards.hpp"
#include "firmware/measure/capture_session.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {

std::string explain_missing_card(StatusCode status, const CaptureSession& session) {
  if (status != StatusCode::card_not_found) return "";
  const PairSetup& setup = session.setup();
  TraySetup tray;
  describe_tray(setup, tray);
  const std::array<CardSight, 2> sights{{{session.view(0).picture.frame(), session.lens(0)},
                                         {session.view(1).picture.frame(), session.lens(1)}}};
  const std::optional<int> other = find_other_card(sights, tray.card);
  if (!other) return "";
  return " " + tell_other_card(*other, tray.card, printable(setup.card.pattern.path.string()));
}

}  // namespace traygauge
