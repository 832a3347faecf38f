// Tables of a station file, written by programs; everything else in the file stays as people wrote it.
#pragma once

#include <filesystem>
#include <string>

#include "firmware/config/station_file.hpp"

namespace traygauge {

// `name`: lens or second_lens. `note` becomes a comment, a line each.
std::string compose_lens_table(const std::string& name, const LensConfig& lens, const std::string& note);
std::string compose_arm_geometry_table(const ArmGeometry& geometry, const std::string& note);

// `text` with the table `name` replaced, or added at the end.
std::string with_table(const std::string& text, const std::string& name, const std::string& table);

// `text` with `key` of the table `name` set to `value`, as TOML has it; the table is added where it is not
// there.
std::string with_value(const std::string& text, const std::string& name, const std::string& key,
                       const std::string& value);
// `text` without that key.
std::string without_value(const std::string& text, const std::string& name, const std::string& key);

// Puts the table into the file, whole or not at all. Throws OutputError, and InputError where the file is no
// station file before or afterwards.
void write_station_table(const std::filesystem::path& file, const std::string& name,
                         const std::string& table);
// The same with one value.
void write_station_value(const std::filesystem::path& file, const std::string& name, const std::string& key,
                         const std::string& value);
void remove_station_value(const std::filesystem::path& file, const std::string& name, const std::string& key);

}  // namespace traygauge
