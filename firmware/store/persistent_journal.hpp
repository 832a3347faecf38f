// The rollback journal that SQLite keeps beside its file: what a killed process leaves in it, and room for
// it.
#pragma once

#include <string>

namespace traygauge {

// SQLite commits when it writes zeroes over the journal's header, and then syncs them. A process that is
// killed between the two, or a sync that fails there, leaves zeroes that every reader sees and a power cut
// takes away: the change could be read and would vanish, and with it might go what the next change had
// written over the rest of the journal. So the zeroes are written and synced again before anything relies on
// them. Does nothing where there is no journal, or one that SQLite is going to roll back. Returns a result
// code of SQLite.
int settle_journal(const char* vfs_name, const std::string& database_file);

// Makes a journal that is there 64 KiB long, with zeroes at its end.
int reserve_journal(const char* vfs_name, const std::string& database_file);

}  // namespace traygauge
