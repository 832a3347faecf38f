// What the steps of `traygauge setup` work on.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drivers/v4l2/device_finder.hpp"
#include "firmware/check/device_check.hpp"
#include "firmware/config/station_file.hpp"
#include "firmware/setup/dialogue.hpp"
#include "firmware/station/station.hpp"

namespace traygauge {

// The devices of a station file, none of them opened yet.
class SetupDevices {
 public:
  SetupDevices() = default;
  SetupDevices(const SetupDevices&) = delete;
  SetupDevices& operator=(const SetupDevices&) = delete;
  virtual ~SetupDevices() = default;
  virtual StationDevices devices() = 0;
};

// What lies outside of this program.
struct SetupTools {
  std::function<std::unique_ptr<SetupDevices>(const StationFile&)> open_devices;
  std::function<CameraList()> list_cameras;
  // A program that lies beside this one, on this one's terminal; its exit status.
  std::function<int(const std::string& name, const std::vector<std::string>& arguments)> run_program;
  std::uint64_t board_pictures = 15;  // of a chessboard; `traygauge calibrate lens` wants 15 to 20
  std::uint64_t more_pictures = 5;    // beside these, where they were not good enough
};

// Of the real station.
SetupTools system_setup_tools();

struct SetupSite {
  Dialogue& dialogue;
  std::filesystem::path file;  // the station file, which the steps write
  SetupTools tools;
  const std::atomic<bool>& stop;

  StationFile read() const { return read_station_file(file); }
  // Beside the station file.
  std::filesystem::path beside(const std::string& name) const { return file.parent_path() / name; }
};

// Of a device in a row while captures are taken, about as many seconds; then the step says so.
inline constexpr int kSetupRetries = 10;

// Says what became of a device; whether it is good.
bool tell(SetupSite& site, const CheckResult& result);

// Tries until it is done, or the person leaves the step out: then false. What is wrong with a file or an
// answer is said.
bool try_until_done(SetupSite& site, const std::function<bool()>& attempt);

// A folder for pictures that nobody needs afterwards.
class PassingFolder {
 public:
  PassingFolder();  // throws OutputError
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  ~PassingFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace traygauge
