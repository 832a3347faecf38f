// `traygauge restore`: a station's configuration out of a backup.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

struct RestoreOptions {
  std::filesystem::path backup;  // a tar.gz
  std::filesystem::path folder;  // made where it is missing
  std::string name;              // the station's from now on; empty: as it was
  bool force = false;            // replaces files that are there
};

void add_restore_command(Program& program, RestoreOptions& options);

// Checks everything before it writes anything, then reads what it wrote as `config check` does. Exit status:
// that one's. Throws UsageError for a backup that is damaged or wants to write elsewhere, and for files that
// are there.
int run_restore(const RestoreOptions& options, std::ostream& out);

}  // namespace traygauge
