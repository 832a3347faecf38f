// Measurements of whole captures as CSV rows, with the decimals that release builds agree on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/config/profile.hpp"
#include "firmware/segment/label_source.hpp"
#include "firmware/segment/pair_labels.hpp"

namespace traygauge::golden {

struct Route {
  const char* name = "";  // of the file
  Profile profile = Profile::best;
  LabelSource labels = LabelSource::given;
};

// "capture,pair,label,…": the names of the columns.
std::string header_row();

// A row a pair (status, pose, warnings), then a row an item, for every pair of every capture below `folder`,
// in the order of their names. Captures of several dishes are left out for profile paper, which measures one.
std::vector<std::string> measure_rows(const std::filesystem::path& folder, const Route& route);

}  // namespace traygauge::golden
