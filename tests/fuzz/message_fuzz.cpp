// What comes over the socket between station and hub, in pieces: first a byte, the size of a piece less one.
// What is read as messages is what was sent, byte by byte, and what the hub tells of the next tray and of
// drift keeps its meaning.
#include <string>
#include <string_view>
#include <vector>

#include "firmware/handover/message.hpp"
#include "firmware/handover/next_tray.hpp"
#include "firmware/handover/told_drift.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace traygauge {
namespace {

void check_told_tray(const std::string& text) {
  static const std::vector<std::string> styles{"dinner", "soup"};
  const Expected<ToldTray> told = read_told_tray(text, styles);
  if (!told.ok()) return demand(!told.failure().empty(), "a sentence about the next tray");
  const Expected<ToldTray> again = read_told_tray(told_tray_json(*told), styles);
  demand(again.ok(), "what was read of the next tray is read again");
  demand(again->hint.tray == told->hint.tray && again->hint.foods == told->hint.foods &&
             again->hint.dishes == told->hint.dishes && again->valid_for == told->valid_for,
         "the next tray stays the same");
}

void check_told_drift(const std::string& text) {
  const Expected<std::vector<ToldTrend>> told = read_told_drift(text);
  if (!told.ok()) return demand(!told.failure().empty(), "a sentence about drift");
  const Expected<std::vector<ToldTrend>> again = read_told_drift(told_drift_json(*told));
  demand(again.ok() && *again == *told, "what is told of drift stays the same");
}

}  // namespace
}  // namespace traygauge

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace traygauge;
  std::string_view sent = text_of_input(data, size);
  const std::size_t piece = take_byte(sent) + 1;
  MessageReader reader;
  std::string encoded;
  for (std::size_t at = 0; at < sent.size(); at += piece) {
    reader.append(sent.substr(at, piece));
    for (;;) {
      const Expected<std::optional<Message>> next = reader.next();
      if (!next.ok()) {
        demand(!next.failure().empty(), "a sentence about what is no message");
        return 0;
      }
      if (!*next) break;
      encoded += encode(**next);
      demand(sent.starts_with(encoded), "messages are encoded as they came");
      check_told_tray((*next)->text);
      check_told_drift((*next)->text);
    }
  }
  demand(reader.holds_part() == (encoded.size() < sent.size()), "nothing is left but a part of a message");
  return 0;
}
