// Whether a file was written by a newer program, without a lock: a station may be running on it.
#pragma once

#include <filesystem>

#include "firmware/base/expected.hpp"

namespace traygauge {

// Of the journal, and of the counter of scans. They fail where a newer program wrote the file, or it cannot
// be read; an absent file is none, and what is damaged is met when the station opens it.
Expected<void> check_journal_format(const std::filesystem::path& file);
Expected<void> check_counter_format(const std::filesystem::path& file);

}  // namespace traygauge
