// What a journal has to tell: for the log, the page and the person who looks after the station.
#pragma once

#include <cstdint>
#include <string>

namespace traygauge {

struct JournalNotice {
  enum class Kind {
    created,
    resized,
    size_kept,      // another size is configured, but what waits does not fit or the disk refused
    cut_off,        // the file was shorter than it was made
    head_repaired,  // one of two heads, from the other: a power cut while it was written, or damage
    interrupted,    // the newest record is not whole: a power cut during its append, or damage since
    damaged,        // records that were whole once are not any more
  };

  Kind kind = Kind::created;
  std::string text;  // one sentence or two, with the file
  // Of `interrupted` and `damaged`.
  std::uint64_t first_sequence = 0;
  std::uint64_t last_sequence = 0;
  std::uint64_t bytes = 0;  // in the ring, whole blocks
  std::string kept_in;      // the file that has these bytes now; empty where it could not be written
};

}  // namespace traygauge
