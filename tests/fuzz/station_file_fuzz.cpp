// Any bytes as a station file: the station and the hub read it, or one sentence says why not. Where it can be
// read, a program writes the lens into it, and then it can still be read.
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/config/hub_tables.hpp"
#include "firmware/config/station_file.hpp"
#include "firmware/config/station_writing.hpp"
#include "firmware/hub/hub_web.hpp"
#include "simulator/capture/input_error.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

void check_sentence(std::string_view sentence) {
  demand(!sentence.empty() && sentence == printable(std::string(sentence)), "a sentence on one line");
  demand(sentence.find("expected ") != std::string_view::npos, "a sentence that says what was expected");
}

class FuzzedFile {
 public:
  void read(std::string_view content) const {
    write(content);
    try {
      const HubFile file = read_hub_file(file_, file_);
      const Expected<void> checked = HubWeb::check(file.hub.web);
      demand(checked.ok() || !checked.failure().empty(), "a sentence about the API");
    } catch (const InputError& error) {
      check_sentence(error.what());
    }
    if (read_station()) check_writing();
  }

 private:
  void write(std::string_view content) const {
    std::ofstream(file_, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
  }
  std::optional<StationFile> read_station() const {
    try {
      return read_station_file(file_);
    } catch (const InputError& error) {
      check_sentence(error.what());
      return std::nullopt;
    }
  }
  // What a calibration does.
  void check_writing() const {
    LensConfig lens;
    lens.camera = {{1600, 1200}, 1396.5, 1396.5, 801.5, 597.5, {}};
    try {
      write_station_table(file_, "lens", compose_lens_table("lens", lens, "as it was found"));
    } catch (const InputError& error) {
      return check_sentence(error.what());
    }
    demand(read_station().has_value(), "a file that a program wrote is read");
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "station.toml";
};

}  // namespace
}  // namespace traygauge

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const traygauge::FuzzedFile file;
  file.read(traygauge::text_of_input(data, size));
  return 0;
}
