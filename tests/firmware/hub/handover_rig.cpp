// A station without devices that measures as fast as it can: handover_rig FOLDER PREFIX COUNT
// Each tray is named PREFIX and a number. On standard output, a line for each tray once its lamp would say
// so: "done NAME" or "kept NAME". After COUNT trays it waits until the hub has everything, and prints
// "empty".
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>

#include "core/pipeline/measurement.hpp"
#include "firmware/handover/scan_handover.hpp"
#include "firmware/journal/posix_file_system.hpp"
#include "firmware/station/scan_printer.hpp"

namespace {

using namespace traygauge;

// At once: what is only in this process's memory dies with it.
void say(const std::string& line) {
  const std::string text = line + "\n";
  if (::write(STDOUT_FILENO, text.data(), text.size()) < 0) std::_Exit(3);
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 4) return 2;
  const std::string folder = arguments[1];
  const std::string prefix = arguments[2];
  const int count = std::atoi(arguments[3]);
  Expected<KeptResults> kept =
      KeptResults::open(posix_file_system(), {folder, "kitchen", std::uint64_t{1} << 20U});
  if (!kept.ok()) {
    std::cerr << kept.failure() << std::endl;
    return 2;
  }
  HubLinkParams link_params;
  link_params.socket = folder + "/hub";
  link_params.station = "kitchen";
  link_params.answer_timeout = Milliseconds(200);
  link_params.retry_after = Milliseconds(1);
  HubLink link(link_params);
  std::ostringstream unread;
  ScanPrinter printer(unread, unread, ScanPrinter::Format::text);
  ScanHandoverParams params;
  params.retry_after = Milliseconds(1);
  ScanHandover sink(printer, link, *kept, unread, params);

  ItemResult item;
  item.label = 2;
  item.volume_ml = 123.0;
  Measurement measurement;
  measurement.items = {&item, 1};
  ScanResult result;
  result.outcome = ScanOutcome::measured;
  result.measurement = &measurement;
  for (int i = 1; i <= count;) {
    sink.attend();
    if (!sink.has_room()) {
      std::this_thread::sleep_for(Milliseconds(1));
      continue;
    }
    const std::string tray = prefix + "-" + std::to_string(i++);
    result.tray = tray;
    const Delivery delivery = sink.deliver(result);
    if (delivery == Delivery::failed) continue;
    say((delivery == Delivery::done ? "done " : "kept ") + tray);
  }
  while (kept->waiting_count() > 0) {
    sink.attend();
    std::this_thread::sleep_for(Milliseconds(1));
  }
  say("empty");
  return 0;
}
