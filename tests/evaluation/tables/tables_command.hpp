// The command line of traygauge-paper-tables.
#pragma once

#include <iosfwd>

namespace traygauge::tables {

// Returns the exit status: 0 done, 2 wrong use, unreadable input or unwritable output.
int run_tables_command(int argument_count, const char* const* arguments, std::ostream& out,
                       std::ostream& error);

}  // namespace traygauge::tables
