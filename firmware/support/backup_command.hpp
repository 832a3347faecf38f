// `traygauge backup`: a station's configuration in one file.
#pragma once

#include <filesystem>
#include <iosfwd>

namespace traygauge {

class Program;

struct BackupOptions {
  std::filesystem::path station;  // a station file
  std::filesystem::path out;      // a tar.gz
  bool with_secrets = false;
};

void add_backup_command(Program& program, BackupOptions& options);

// Takes the station file, each regular file that it names, and dishes/*.toml beside it; not the results. Exit
// status: 0. Throws InputError where the station file is not TOML, UsageError where a file cannot be read or
// the archive cannot be written.
int run_backup(const BackupOptions& options, std::ostream& out);

}  // namespace traygauge
