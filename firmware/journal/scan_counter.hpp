// The numbers of a station's scans.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "firmware/base/expected.hpp"
#include "firmware/journal/file_system.hpp"

namespace traygauge {

// So many numbers are reserved by one write of 4,096 bytes and one sync.
inline constexpr std::uint64_t kNumbersReserved = 64;
// Left out where the file was lost: more scans than a station makes between two looks at it.
inline constexpr std::uint64_t kNumbersLeftOut = 1'000'000;

// Counts from 1 and gives no number twice, whatever stops the program. Numbers may be left out: up to 63
// after a crash, and up to 127 where one of the file's two blocks is damaged. Where both are, it goes on a
// million after the largest number that the caller knows: none is given twice as long as journal or hub know
// one of the last million. For one thread.
class ScanCounter {
 public:
  // `largest_known`: the largest number that journal or hub know; 0 where they know none. A file that lags
  // behind it, is damaged or absent is mended, and notice() says so. Fails where another process has the file
  // open, a newer program wrote it, or the disk refuses.
  static Expected<std::unique_ptr<ScanCounter>> open(FileSystem& file_system, const std::string& path,
                                                     std::uint64_t largest_known);
  ScanCounter(const ScanCounter&) = delete;
  ScanCounter& operator=(const ScanCounter&) = delete;
  ~ScanCounter();  // gives unused numbers back

  // Fails where the disk refuses to reserve; a later call may succeed.
  Expected<std::uint64_t> next();

  // What opening met, for people; empty where all was well.
  const std::string& notice() const { return notice_; }

  // Whether a newer program wrote this slot of such a file; it may be damaged. At least 16 bytes.
  static bool is_newer(std::span<const std::byte> slot);

  // What a block of the file says.
  struct Reservation {
    std::uint64_t generation = 0;   // its parity says in which block it is
    std::uint64_t reserved_to = 0;  // no number up to here is given by the next process
  };

 private:
  ScanCounter(std::string path, std::unique_ptr<File> lock)
      : path_(std::move(path)), lock_(std::move(lock)) {}

  Expected<void> load(FileSystem& file_system, std::uint64_t largest_known);
  Expected<void> create(FileSystem& file_system, std::uint64_t reserved_to);
  Expected<void> take(const Reservation& newest, bool is_whole, std::uint64_t largest_known);
  std::error_code write_durably(const Reservation& reservation);
  std::error_code reserve_to(std::uint64_t number);

  std::string path_;
  std::unique_ptr<File> lock_;
  std::unique_ptr<File> file_;
  std::uint64_t generation_ = 0;
  std::uint64_t reserved_to_ = 0;
  std::uint64_t last_ = 0;
  std::string notice_;
};

}  // namespace traygauge
