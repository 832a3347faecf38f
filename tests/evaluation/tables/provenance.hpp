// What a report's figures were computed from, and by what.
#pragma once

#include <set>
#include <string>

#include "tests/evaluation/tables/set_folders.hpp"
#include "tests/evaluation/tables/table_runner.hpp"

namespace traygauge::tables {

// In Markdown: program, sets and where they come from, pairs and seeds, captures left out, how time was
// taken. Throws InputError.
std::string compose_provenance(const SetFolders& sets, const RunnerOptions& options,
                               const std::set<std::string>& skipped);

}  // namespace traygauge::tables
