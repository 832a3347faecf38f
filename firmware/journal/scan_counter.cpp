#include "firmware/journal/scan_counter.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/base/crc32c.hpp"
#include "core/base/little_endian.hpp"
#include "firmware/journal/io_failure.hpp"
#include "firmware/journal/lock_file.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kSlotBytes = 4096;              // what a disk writes anyway for a byte
constexpr std::size_t kSlotCount = 2;                 // written in turn: a torn one leaves the other
constexpr std::uint64_t kMagic = 0x4e55434e41435354;  // "TSCANCUN"
constexpr std::uint32_t kCounterVersion = 1;
constexpr std::size_t kVersionOffset = 8;
constexpr std::size_t kGenerationOffset = 16;
constexpr std::size_t kReservedOffset = 24;
constexpr std::size_t kCrcOffset = kSlotBytes - sizeof(std::uint32_t);

using Slot = std::array<std::byte, kSlotBytes>;

using Reservation = ScanCounter::Reservation;

struct FoundSlots {
  std::optional<Reservation> newest;
  bool all_intact = true;
  bool is_newer_version = false;
};

std::uint64_t slot_offset(std::uint64_t generation) {
  return generation % kSlotCount * kSlotBytes;
}

Slot encode_slot(const Reservation& content) {
  Slot slot{};
  store_little_endian(slot, 0, kMagic);
  store_little_endian(slot, kVersionOffset, kCounterVersion);
  store_little_endian(slot, kGenerationOffset, content.generation);
  store_little_endian(slot, kReservedOffset, content.reserved_to);
  store_little_endian(slot, kCrcOffset, crc32c(std::span(slot).first(kCrcOffset)));
  return slot;
}

void read_slot(File& file, std::uint64_t index, FoundSlots& found) {
  Slot slot{};
  const auto read = file.read_at(index * kSlotBytes, slot);
  if (ScanCounter::is_newer(slot)) found.is_newer_version = true;
  const Reservation content{load_little_endian<std::uint64_t>(slot, kGenerationOffset),
                            load_little_endian<std::uint64_t>(slot, kReservedOffset)};
  const bool intact =
      read.ok() && load_little_endian<std::uint64_t>(slot, 0) == kMagic &&
      load_little_endian<std::uint32_t>(slot, kVersionOffset) == kCounterVersion &&
      content.generation % kSlotCount == index &&
      load_little_endian<std::uint32_t>(slot, kCrcOffset) == crc32c(std::span(slot).first(kCrcOffset));
  if (!intact) {
    found.all_intact = false;
  } else if (!found.newest || found.newest->generation < content.generation) {
    found.newest = content;
  }
}

std::string damaged_path(const std::string& path) {
  return path + ".damaged";
}

std::uint64_t plus(std::uint64_t number, std::uint64_t more) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  return number > kMost - more ? kMost : number + more;
}

}  // namespace

bool ScanCounter::is_newer(std::span<const std::byte> slot) {
  return load_little_endian<std::uint64_t>(slot, 0) == kMagic &&
         load_little_endian<std::uint32_t>(slot, kVersionOffset) > kCounterVersion;
}

Expected<std::unique_ptr<ScanCounter>> ScanCounter::open(FileSystem& file_system, const std::string& path,
                                                         std::uint64_t largest_known) {
  auto lock = lock_file(file_system, path);
  if (!lock.ok()) return Failure{lock.failure()};
  std::unique_ptr<ScanCounter> counter(new ScanCounter(path, std::move(*lock)));
  if (const auto loaded = counter->load(file_system, largest_known); !loaded.ok()) {
    return Failure{loaded.failure()};
  }
  return counter;
}

Expected<void> ScanCounter::load(FileSystem& file_system, std::uint64_t largest_known) {
  auto opened = file_system.open(path_, OpenMode::existing);
  if (opened.error == std::errc::no_such_file_or_directory) {
    // Killed after a damaged file was moved away, and before there was a new one.
    const bool was_damaged = file_system.open(damaged_path(path_), OpenMode::existing).ok();
    if (largest_known == 0 && !was_damaged) return create(file_system, 0);
    notice_ = path_ +
              ": the counter of scans is absent although this station has scanned before. A million "
              "numbers are left out, so that none is given twice.";
    return create(file_system, plus(largest_known, kNumbersLeftOut));
  }
  if (!opened.ok()) return io_failure(path_, "the counter of scans could not be opened", opened.error);
  FoundSlots found;
  for (std::uint64_t index = 0; index < kSlotCount; ++index) read_slot(*opened.value, index, found);
  if (!found.newest && found.is_newer_version) {
    return Failure{path_ + ": a newer program wrote this counter of scans. Install that program again."};
  }
  if (!found.newest) {
    const std::string aside = damaged_path(path_);
    if (const auto error = file_system.rename(path_, aside)) {
      return io_failure(path_, "the damaged counter of scans could not be moved away", error);
    }
    notice_ = path_ + ": the counter of scans is damaged and was moved to " + aside +
              ". A million numbers are left out, so that none is given twice. Check the disk or card.";
    return create(file_system, plus(largest_known, kNumbersLeftOut));
  }
  file_ = std::move(opened.value);
  // The name may be new: of a program that was killed before it came to this.
  if (const auto error = file_system.sync_folder_of(path_)) {
    return io_failure(path_, "the folder of the counter of scans could not be written", error);
  }
  return take(*found.newest, found.all_intact, largest_known);
}

Expected<void> ScanCounter::take(const Reservation& newest, bool is_whole, std::uint64_t largest_known) {
  generation_ = newest.generation;
  reserved_to_ = newest.reserved_to;
  if (!is_whole) {
    // The lost block may have been the newer one, which reserved so many numbers more.
    reserved_to_ = plus(reserved_to_, kNumbersReserved);
    notice_ = path_ +
              ": one of two blocks of the counter of scans was not whole, after a power cut or by damage. " +
              std::to_string(kNumbersReserved) + " numbers are left out, so that none is given twice.";
  }
  if (reserved_to_ < largest_known) {
    reserved_to_ = largest_known;
    notice_ = path_ + ": the counter of scans lagged behind scan " + std::to_string(largest_known) +
              ", which is known already. It goes on from there.";
  }
  last_ = reserved_to_;
  const auto write = [&]() -> std::error_code {
    // The newer block may be in the kernel's memory alone, if a sync failed: it is written anew before the
    // other one, which may be the only one on the disk.
    if (const std::error_code error = write_durably(newest)) return error;
    if (notice_.empty()) return {};
    // A leap goes into both blocks: one must never lag behind the other by more than a reservation.
    if (const std::error_code error = reserve_to(reserved_to_)) return error;
    return reserve_to(reserved_to_);
  };
  if (const std::error_code error = write()) {
    return io_failure(path_, "the counter of scans could not be written", error);
  }
  return {};
}

// Takes its name only when it is whole.
Expected<void> ScanCounter::create(FileSystem& file_system, std::uint64_t reserved_to) {
  const std::string unfinished = path_ + ".new";
  const auto write = [&]() -> std::error_code {
    auto opened = file_system.open(unfinished, OpenMode::emptied);
    if (!opened.ok()) return opened.error;
    file_ = std::move(opened.value);
    for (std::uint64_t generation = 0; generation < kSlotCount; ++generation) {
      const Slot slot = encode_slot({generation, reserved_to});
      if (const auto error = file_->write_at(slot_offset(generation), slot)) return error;
    }
    if (const auto error = file_->sync_data()) return error;
    if (const auto error = file_system.rename(unfinished, path_)) return error;
    return file_system.sync_folder_of(path_);
  };
  if (const auto error = write()) {
    return io_failure(path_, "the counter of scans could not be made", error);
  }
  generation_ = kSlotCount - 1;
  reserved_to_ = reserved_to;
  last_ = reserved_to;
  return {};
}

ScanCounter::~ScanCounter() {
  if (file_ != nullptr && last_ < reserved_to_) std::ignore = reserve_to(last_);
}

std::error_code ScanCounter::write_durably(const Reservation& reservation) {
  const Slot slot = encode_slot(reservation);
  if (const std::error_code error = file_->write_at(slot_offset(reservation.generation), slot)) return error;
  return file_->sync_data();
}

std::error_code ScanCounter::reserve_to(std::uint64_t number) {
  if (const std::error_code error = write_durably({generation_ + 1, number})) return error;
  // Only now: the other block must not be written before this one is durable.
  ++generation_;
  reserved_to_ = number;
  return {};
}

Expected<std::uint64_t> ScanCounter::next() {
  if (last_ == std::numeric_limits<std::uint64_t>::max()) {
    return Failure{
        path_ + ": the counter of scans is at its end. Give the station another name and remove this file."};
  }
  if (last_ == reserved_to_) {
    if (const std::error_code error = reserve_to(plus(reserved_to_, kNumbersReserved))) {
      return io_failure(path_, "the counter of scans could not be written", error);
    }
  }
  return ++last_;
}

}  // namespace traygauge
