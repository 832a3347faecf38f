#include "firmware/support/machine_facts.hpp"

#include <sys/statvfs.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>

#include "firmware/base/board_state.hpp"
#include "firmware/base/build_info.hpp"
#include "firmware/base/text.hpp"
#include "firmware/base/wall_clock.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line.substr(0, line.find('\0'));  // the device tree ends its texts with one
}

// The first line of the file that begins so; empty: there is none.
std::string line_of(const fs::path& file, const std::string& beginning) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(beginning)) return line;
  }
  return {};
}

std::vector<fs::path> sorted_entries(const fs::path& folder, const std::string& beginning) {
  std::vector<fs::path> entries;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().starts_with(beginning)) entries.push_back(entry.path());
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

std::string describe_machine() {
  std::string model = first_line("/proc/device-tree/model");
  if (model.empty()) model = first_line("/sys/class/dmi/id/product_name");
  const std::string processor = line_of("/proc/cpuinfo", "model name");
  if (!processor.empty()) model += (model.empty() ? "" : ",") + processor.substr(processor.find(':') + 1);
  return model.empty() ? "not known" : model;
}

// By their files: a package's name says the rest.
std::string list_loaded_libraries() {
  std::set<std::string> files;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t slash = line.find('/');
    if (slash == std::string::npos || line.find(".so", slash) == std::string::npos) continue;
    files.insert(line.substr(slash));
  }
  std::string text;
  for (const std::string& file : files) text += "  " + file + "\n";
  return text;
}

std::string describe_temperatures() {
  constexpr double kMillidegrees = 1000.0;
  std::string text;
  for (const fs::path& zone : sorted_entries("/sys/class/thermal", "thermal_zone")) {
    const std::string millidegrees = first_line(zone / "temp");
    if (millidegrees.empty()) continue;
    text += "temperature of " + first_line(zone / "type") + ": " +
            fixed(std::strtod(millidegrees.c_str(), nullptr) / kMillidegrees, 1) + " °C\n";
  }
  return text.empty() ? "temperature: the kernel does not tell it here\n" : text;
}

std::string describe_voltage() {
  const std::optional<bool> under_voltage = read_board_state().under_voltage;
  if (!under_voltage) return "supply voltage: the kernel does not tell it here\n";
  if (!*under_voltage) return "supply voltage: it was never too low since the board started\n";
  return "supply voltage: too low now, or was since the board started: take a stronger power supply and a "
         "shorter, thicker cable\n";
}

std::string describe_memory() {
  std::string text;
  for (const char* const name : {"MemTotal:", "MemAvailable:", "SwapTotal:", "SwapFree:"}) {
    const std::string line = line_of("/proc/meminfo", name);
    if (!line.empty()) text += line + "\n";
  }
  return text.empty() ? "memory: the kernel does not tell it here\n" : text;
}

// Of the nearest folder above that is there.
std::string describe_disk(fs::path folder) {
  std::error_code ignored;
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  struct statvfs found {};
  if (folder.empty() || ::statvfs(folder.c_str(), &found) != 0) return {};
  const auto text_of = [&found](std::uint64_t blocks) { return mebibytes(blocks * found.f_frsize); };
  std::string text =
      folder.string() + ": " + text_of(found.f_bavail) + " MiB free of " + text_of(found.f_blocks);
  text.append(" MiB, ").append(std::to_string(found.f_favail)).append(" files can be made");
  return text + ((found.f_flag & ST_RDONLY) != 0 ? ", read only\n" : "\n");
}

}  // namespace

std::string describe_versions() {
  utsname kernel{};
  ::uname(&kernel);
  std::string text = describe_build("traygauge") + "\n";
  text.append("made at ").append(utc_text(read_wall_clock().unix_ms));
  text.append(read_wall_clock().synchronised ? ", the clock is synchronised\n"
                                             : ", the clock is not synchronised\n");
  text.append("kernel ").append(kernel.sysname).append(" ").append(kernel.release).append(" ");
  text.append(kernel.version).append(" ").append(kernel.machine).append("\n");
  const std::string distribution = line_of("/etc/os-release", "PRETTY_NAME=");
  text.append("distribution ").append(distribution.substr(distribution.find('=') + 1)).append("\n");
  text.append("machine ").append(describe_machine()).append("\n");
  return text.append("libraries of this program:\n").append(list_loaded_libraries());
}

std::string describe_state(const std::vector<fs::path>& folders) {
  std::string text = describe_temperatures() + describe_voltage() + describe_memory();
  text.append("seconds since the start: ").append(first_line("/proc/uptime")).append("\n");
  text.append("load: ").append(first_line("/proc/loadavg")).append("\n");
  std::set<std::string> disks;
  for (const fs::path& folder : folders) disks.insert(describe_disk(fs::absolute(folder)));
  for (const std::string& disk : disks) text += disk;
  return text;
}

}  // namespace traygauge
