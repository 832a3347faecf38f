#include "firmware/config/setup_progress.hpp"

#include "firmware/config/hub_tables.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/toml_file.hpp"

namespace traygauge {

std::optional<SetupProgress> read_setup_progress(const std::filesystem::path& station_file) {
  try {
    const JsonDocument document = read_toml(station_file, kMaxStationFileBytes, "a station in TOML");
    const JsonNode root = document.root();
    const auto has = [&root](const char* key) { return root.find(key).has_value(); };
    return SetupProgress{has("card"), has("lens") && (has("second_lens") || !has("second_camera")),
                         has("arm_geometry") || !has("arm")};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace traygauge
