// What a station file says, key by key, for commands that want its paths or show it: also of a file that
// nobody else can read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/support/secret_filter.hpp"

namespace traygauge {

struct StationValue {
  std::string key;   // "hub.listen[0]"
  std::string text;  // a text's content, or a number or truth as TOML writes it
  bool is_text = false;
  int line = 0;  // of a file that is not TOML; 0: not known
};

struct StationValues {
  std::filesystem::path file;
  std::string problem;  // why it is not TOML, or cannot be read; empty: it is TOML
  std::vector<StationValue> values;

  std::filesystem::path folder() const { return file.has_parent_path() ? file.parent_path() : "."; }
  // Of a text that names a file.
  std::filesystem::path path_of(const StationValue& value) const { return folder() / value.text; }
  // The text of this key; empty: there is none.
  std::string text_of(const std::string& key) const;
};

// Where the file is not TOML: the lines of it that have a key and a value of their own.
StationValues read_station_values(const std::filesystem::path& file);

// Whether a key's value is a secret or names a file with one: "view_tokens", "webhook_secret".
bool is_secret_key(const std::string& key);

// The file for others: a line for each key, no comment, of the webhook scheme and host, paths of secret files
// without what they hold. Texts of keys that Traygauge does not know are removed: they may be anything.
std::string show_station_values(const StationValues& station);

// Tells the filter each secret that the file names or holds, and what files beside it hold whose names have
// "token" or "secret". Returns those that are there and cannot be read, so that nobody can look for their
// content.
std::vector<std::filesystem::path> add_station_secrets(const StationValues& station, SecretFilter& filter);

}  // namespace traygauge
