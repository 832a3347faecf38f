#include "firmware/setup/setup_site.hpp"

#include <cstdlib>
#include <system_error>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/sibling_program.hpp"
#include "firmware/station/hardware.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/output_file.hpp"

namespace traygauge {
namespace {

class SystemDevices final : public SetupDevices {
 public:
  explicit SystemDevices(const StationFile& station) : hardware_(station) {}
  StationDevices devices() override { return hardware_.devices(); }

 private:
  Hardware hardware_;
};

}  // namespace

SetupTools system_setup_tools() {
  SetupTools tools;
  tools.open_devices = [](const StationFile& station) { return std::make_unique<SystemDevices>(station); };
  tools.list_cameras = [] { return list_cameras(*make_system_video_device()); };
  tools.run_program = run_sibling_program;
  return tools;
}

bool tell(SetupSite& site, const CheckResult& result) {
  site.dialogue.say(printable(result.device) + ": " + printable(result.text));
  return result.is_good;
}

bool try_until_done(SetupSite& site, const std::function<bool()>& attempt) {
  do {
    try {
      if (attempt()) return true;
    } catch (const InputError& error) {
      site.dialogue.say(error.what());
    } catch (const UsageError& error) {
      site.dialogue.say(error.what());
    }
  } while (site.dialogue.try_again());
  return false;
}

PassingFolder::PassingFolder() {
  std::error_code error;
  std::string name = (std::filesystem::temp_directory_path(error) / "traygauge-setup-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw OutputError(name, "the folder cannot be made");
  path_ = name;
}

PassingFolder::~PassingFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace traygauge
