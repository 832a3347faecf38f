// A whole station, of simulated devices, whose power is cut: it scans as fast as it can, and only its
// measurement is replaced by items that are made up. Usage: cut_station FOLDER SOCKET RUN SCANS MARKS
// Each tray is named RUN and a number. What the lamp says of it is written into the sector of MARKS, past
// every cache but the disk's own: "done NAME", or "kept NAME" where the result waits; "full" once no more
// can wait. With no SCANS it hands over what waits, and prints how many results that were.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "core/pipeline/measurement.hpp"
#include "firmware/handover/scan_handover.hpp"
#include "firmware/journal/posix_file_system.hpp"
#include "firmware/station/scan_printer.hpp"
#include "firmware/station/station.hpp"
#include "simulator/devices/simulated_arm.hpp"
#include "simulator/devices/simulated_camera.hpp"
#include "simulator/devices/simulated_clock.hpp"
#include "simulator/devices/simulated_indicator.hpp"
#include "simulator/devices/simulated_trigger.hpp"
#include "tests/simulator/devices/synthetic_captures.hpp"

namespace {

using namespace traygauge;

constexpr std::uint64_t kJournalBytes = std::uint64_t{256} << 10U;  // full after some twenty results

// One sector of a disk, written in order with what the file systems on that disk write.
class Marks {
 public:
  // `place`: DEVICE@OFFSET_BYTES.
  explicit Marks(const std::string& place) {
    const std::size_t at = place.find('@');
    file_ = ::open(place.substr(0, at).c_str(), O_WRONLY | O_DIRECT);
    if (at == std::string::npos || file_ < 0) throw std::runtime_error(place + ": no DEVICE@OFFSET");
    offset_bytes_ = std::atoll(place.c_str() + at + 1);
  }
  Marks(const Marks&) = delete;
  Marks& operator=(const Marks&) = delete;
  ~Marks() { ::close(file_); }

  void write(const std::string& text) {
    sector_.fill('\0');
    std::memcpy(sector_.data(), text.data(), std::min(text.size(), sector_.size()));
    if (::pwrite(file_, sector_.data(), sector_.size(), offset_bytes_) !=
        static_cast<ssize_t>(sector_.size()))
      throw std::system_error(errno, std::generic_category(), "the mark");
  }

 private:
  alignas(4096) std::array<char, 512> sector_{};
  int file_ = -1;
  off_t offset_bytes_ = 0;
};

// From one item to as many as fill a few blocks of the journal.
class ItemMaker final : public Measurer {
 public:
  explicit ItemMaker(std::string run) : run_(std::move(run)) {}

  void begin_scan(const TrayHint& /*hint*/) override {
    name_ = run_ + "-";
    name_ += std::to_string(++scans_);
  }
  Status add_view(const StationView& /*view*/) override { return {}; }
  const Measurement& measure() override {
    constexpr std::size_t kStep = 7;
    const std::size_t count = 1 + scans_ * kStep % items_.size();
    for (std::size_t i = 0; i < count; ++i) {
      items_[i].label = static_cast<std::uint8_t>(i + 2);
      items_[i].volume_ml = static_cast<double>(scans_) + static_cast<double>(i) / 1024.0;
    }
    measurement_ = {};
    measurement_.items = std::span(items_).first(count);
    return measurement_;
  }
  std::string_view tray_name() const override { return name_; }

 private:
  std::string run_;
  std::string name_;
  std::size_t scans_ = 0;
  std::array<ItemResult, 40> items_;
  Measurement measurement_;
};

// Passes everything on to the handover, and marks what is kept.
class MarkedSink final : public ResultSink {
 public:
  MarkedSink(ScanHandover& handover, Marks& marks) : handover_(handover), marks_(marks) {}

  Delivery deliver(const ScanResult& result) override {
    const Delivery delivery = handover_.deliver(result);
    if (delivery == Delivery::kept) marks_.write("kept " + std::string(result.tray));
    return delivery;
  }
  TrayHint next_tray() override { return handover_.next_tray(); }
  // The simulated clock leaps over what it waits for; the hub needs the time.
  bool has_room() override {
    const bool has_room = handover_.has_room();
    if (!has_room && !is_full_) marks_.write("full");
    if (!has_room) std::this_thread::sleep_for(Milliseconds(1));
    is_full_ = !has_room;
    return has_room;
  }
  void attend() override { handover_.attend(); }
  void report_state(std::string_view state) override { handover_.report_state(state); }
  void report_fault(const DeviceFailure& failure) override { handover_.report_fault(failure); }
  void report_restart() override { handover_.report_restart(); }
  void report_recovery(std::string_view what) override { handover_.report_recovery(what); }

 private:
  ScanHandover& handover_;
  Marks& marks_;
  bool is_full_ = false;
};

int hand_over_what_waits(ScanHandover& handover, const KeptResults& kept) {
  const std::size_t waiting = kept.waiting_count();
  while (kept.waiting_count() > 0) {
    handover.attend();
    std::this_thread::sleep_for(Milliseconds(1));
  }
  std::cout << waiting << std::endl;
  return 0;
}

int scan(ScanHandover& handover, const std::string& run, std::uint64_t scans, const std::string& place) {
  Marks marks(place);
  MarkedSink sink(handover, marks);
  ItemMaker measurer(run);
  SimulatedClock clock;
  SyntheticCaptures captures(1);
  TrayPlayer player(captures, CameraMover::arm);
  SimulatedArm arm(clock, &player);
  SimulatedCamera camera(clock, player, &arm);
  SimulatedIndicator lamp(clock);
  SimulatedTrigger trigger(clock, lamp, scans, {.tries = std::numeric_limits<int>::max()});
  trigger.before_press([&player] { player.handle_press(); });
  lamp.on_signal([&](Signal signal) {
    player.handle_signal(signal);
    if (signal == Signal::done) marks.write("done " + std::string(measurer.tray_name()));
  });
  StationParams params;
  params.max_scans = scans;
  params.repeat_within = Nanoseconds::zero();
  const std::atomic<bool> stop = false;
  Station station({camera, trigger, &arm, lamp, clock}, measurer, sink, stop, params);
  return station.run().all_worked() ? 0 : 1;
}

int run(char** arguments) {
  const std::string folder = arguments[1];
  Expected<KeptResults> kept = KeptResults::open(posix_file_system(), {folder, "kitchen", kJournalBytes});
  if (!kept.ok()) throw std::runtime_error(kept.failure());
  HubLinkParams link_params;
  link_params.socket = arguments[2];
  link_params.station = "kitchen";
  link_params.retry_after = Milliseconds(10);
  HubLink link(link_params);
  std::ostringstream unread;
  ScanPrinter printer(unread, std::cerr, ScanPrinter::Format::text);
  ScanHandoverParams params;
  params.retry_after = Milliseconds(10);
  ScanHandover handover(printer, link, *kept, std::cerr, params);
  const auto scans = static_cast<std::uint64_t>(std::atoll(arguments[4]));
  return scans == 0 ? hand_over_what_waits(handover, *kept)
                    : scan(handover, arguments[3], scans, arguments[5]);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 6) {
    std::cerr << "usage: cut_station FOLDER SOCKET RUN SCANS MARKS" << std::endl;
    return 2;
  }
  try {
    return run(arguments);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
}
