#include "firmware/support/station_values.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "firmware/base/toml_text.hpp"
#include "firmware/config/hub_tables.hpp"
#include "firmware/support/durable_files.hpp"
#include "firmware/webhook/webhook_address.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/toml_file.hpp"

namespace traygauge {
namespace {

constexpr std::string_view kBlanks = " \t\r";

// Keys whose texts hold no secret, a space around each. A text of any other key is not shown.
constexpr std::string_view kShownKeys =
    " on_bad_config file device format exposure_us gain white_balance_k focus lens_changed_on line bias "
    "lines ready hold_still busy done try_again fault move_on far_enough too_far kind step direction "
    "enable home home_bias inverted camera calibrated_on pattern labels dishes name socket folder "
    "store listen view_tokens kiosk_tokens manage_tokens host_names pictures trusted_proxies "
    "base_path webhook webhook_secret webhook_ca site_name time_zone "
    "host ca certificate user prefix delivered home_assistant_prefix ";

// Of "hub.listen[0]": "listen".
std::string_view last_part(std::string_view key) {
  key = key.substr(0, key.find('['));
  return key.substr(key.rfind('.') + 1);
}

bool is_shown_key(const std::string& key) {
  const std::string_view name = last_part(key);
  return name.find(' ') == std::string_view::npos &&
         kShownKeys.find(" " + std::string(name) + " ") != std::string_view::npos;
}

void flatten(const nlohmann::json& json, const std::string& key, std::vector<StationValue>& values) {
  if (json.is_object()) {
    const std::string table = key.empty() ? key : key + ".";
    for (const auto& [name, value] : json.items()) flatten(value, table + name, values);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i)
      flatten(json[i], key + "[" + std::to_string(i) + "]", values);
  } else if (json.is_string()) {
    values.push_back({key, json.get<std::string>(), true, 0});
  } else if (!json.is_null()) {
    values.push_back({key, json.dump(), false, 0});
  }
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

bool is_plain(std::string_view text, std::string_view more) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [more](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           more.find(c) != std::string_view::npos;
  });
}

// The texts in quotes, or the one number or truth.
void scan_value(std::string_view rest, const std::string& key, int line, std::vector<StationValue>& values) {
  constexpr std::size_t kMaxNumberCharacters = 24;
  if (rest.find_first_of("\"'") == std::string_view::npos) {
    const std::string_view number = without_blanks(rest.substr(0, rest.find('#')));
    const bool is_truth = number == "true" || number == "false";
    const bool is_number = number.size() <= kMaxNumberCharacters &&
                           number.find_first_not_of("0123456789+-.e_") == std::string_view::npos;
    if (!number.empty() && (is_truth || is_number)) values.push_back({key, std::string(number), false, line});
    return;
  }
  for (std::size_t at = 0; at < rest.size() && rest[at] != '#'; ++at) {
    if (rest[at] != '"' && rest[at] != '\'') continue;
    const std::size_t end = rest.find(rest[at], at + 1);
    if (end == std::string_view::npos) {
      // What may be secret has to be known, also where its second quote is missing.
      const bool may_be_secret = is_secret_key(key) || last_part(key) == "webhook";
      const std::string_view text = without_blanks(rest.substr(at + 1));
      if (may_be_secret && !text.empty()) values.push_back({key, std::string(text), true, line});
      return;
    }
    if (end > at + 1) values.push_back({key, std::string(rest.substr(at + 1, end - at - 1)), true, line});
    at = end;
  }
}

std::vector<StationValue> scan_lines(const std::filesystem::path& file) {
  std::vector<StationValue> values;
  std::ifstream stream(file, std::ios::binary);
  std::string content(kMaxStationFileBytes, '\0');
  stream.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  std::string table;
  int line = 0;
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = std::min(content.find('\n', begin), content.size());
    const std::string_view text = without_blanks(std::string_view(content).substr(begin, end - begin));
    begin = end + 1;
    ++line;
    if (text.starts_with('[')) {
      const std::string_view name =
          text.substr(1, text.find(']') == std::string_view::npos ? 0 : text.find(']') - 1);
      table = is_plain(name, "_-.") ? std::string(name) + "." : std::string();
      continue;
    }
    const std::size_t sign = text.find('=');
    if (sign == std::string_view::npos) continue;
    const std::string_view key = without_blanks(text.substr(0, sign));
    if (is_plain(key, "_-.")) scan_value(text.substr(sign + 1), table + std::string(key), line, values);
  }
  return values;
}

// A path may stay. What stands in a path's place may be the secret itself, typed there by mistake.
bool is_path_of_secret(const StationValues& station, const StationValue& value) {
  std::error_code ignored;
  const std::filesystem::path path = station.path_of(value);
  if (std::filesystem::exists(path, ignored)) return true;
  const std::filesystem::path folder = path.parent_path();
  return value.text.find('/') != std::string::npos && folder != folder.root_path() &&
         std::filesystem::is_directory(folder, ignored);
}

bool may_show(const StationValues& station, const StationValue& value) {
  if (value.is_text && is_secret_key(value.key)) return is_path_of_secret(station, value);
  if (value.is_text) return is_shown_key(value.key);
  return value.text == "true" || value.text == "false" || !is_secret_key(value.key);
}

std::string shown_value(const StationValues& station, const StationValue& value) {
  if (!may_show(station, value)) return toml_text(std::string(kRemoved));
  if (!value.is_text) return value.text;
  if (last_part(value.key) != "webhook") return toml_text(value.text);
  const Expected<WebhookAddress> address = parse_webhook_address(value.text);
  return toml_text(address.ok() ? address->shown : std::string(kRemoved));
}

// A station file that is absent or half written names them no more.
std::set<std::filesystem::path> secret_files_beside(const StationValues& station) {
  std::set<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(station.folder(), ignored)) {
    const std::string name = entry.path().filename().string();
    const bool is_secret =
        name.find("token") != std::string::npos || name.find("secret") != std::string::npos;
    if (is_secret && entry.is_regular_file(ignored)) files.insert(entry.path());
  }
  return files;
}

}  // namespace

std::string StationValues::text_of(const std::string& key) const {
  const auto found = std::find_if(values.begin(), values.end(), [&key](const StationValue& value) {
    return value.is_text && value.key == key;
  });
  return found == values.end() ? std::string() : found->text;
}

StationValues read_station_values(const std::filesystem::path& file) {
  StationValues station;
  station.file = file;
  try {
    flatten(read_toml(file, kMaxStationFileBytes, "a station in TOML").value(), "", station.values);
  } catch (const InputError& error) {
    station.problem = error.what();
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) station.values = scan_lines(file);
  }
  return station;
}

bool is_secret_key(const std::string& key) {
  constexpr auto kParts =
      std::to_array<std::string_view>({"token", "secret", "pass", "private", "_key", "pin"});
  const std::string_view name = last_part(key);
  return std::any_of(kParts.begin(), kParts.end(),
                     [name](std::string_view part) { return name.find(part) != std::string_view::npos; });
}

std::string show_station_values(const StationValues& station) {
  std::string text;
  if (station.problem.empty()) {
    text = "# What the station file says, without its comments and without what may be secret.\n";
  } else {
    text.append("# The station file cannot be read: ").append(station.problem);
    text.append("\n# Its lines that have a key and a value, with their numbers:\n");
  }
  std::string list;  // whose entries stand on one line
  for (const StationValue& value : station.values) {
    const std::size_t bracket = value.key.find('[');
    const std::string name = value.key.substr(0, bracket);
    if (!list.empty() && list != name) text += "]\n";
    const bool goes_on = !list.empty() && list == name && bracket != std::string::npos;
    list = bracket == std::string::npos ? std::string() : name;
    if (goes_on) {
      text += ", " + shown_value(station, value);
      continue;
    }
    if (value.line != 0) text += std::to_string(value.line) + ": ";
    text += name + (list.empty() ? " = " : " = [") + shown_value(station, value);
    if (list.empty()) text += "\n";
  }
  return list.empty() ? text : text + "]\n";
}

std::vector<std::filesystem::path> add_station_secrets(const StationValues& station, SecretFilter& filter) {
  std::set<std::filesystem::path> files = secret_files_beside(station);
  for (const StationValue& value : station.values) {
    if (last_part(value.key) == "webhook") filter.add_address(value.text);
    if (!may_show(station, value)) filter.add(value.text);
    if (value.is_text && is_secret_key(value.key)) files.insert(station.path_of(value));
  }
  std::vector<std::filesystem::path> unread;
  for (const std::filesystem::path& file : files) {
    constexpr std::size_t kMaxSecretFileBytes = 64UL * 1024;  // as the hub has it
    std::error_code hidden;  // also where it is in a folder that is closed to this user
    if (!std::filesystem::exists(file, hidden) && !hidden) continue;
    const Expected<std::string> content = read_file(file, kMaxSecretFileBytes);
    if (content.ok()) {
      filter.add_file_content(*content);
    } else {
      unread.push_back(file);
    }
  }
  return unread;
}

}  // namespace traygauge
