#include "firmware/memory/memory_command.hpp"

#include <cstddef>
#include <ostream>
#include <span>
#include <string>

#include "core/pipeline/memory_report.hpp"
#include "core/pipeline/tray_estimator.hpp"
#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/command/program.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/network/food_network.hpp"
#include "firmware/paper/paper_profile.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kPartWidth = 36;
constexpr std::size_t kFrames = 2;
constexpr std::size_t kBytesPerPixel = 3 + 1;  // colour and label

std::string row(const std::string& name, std::size_t bytes) {
  return pad_right(name, kPartWidth) + pad_left(std::to_string(bytes), 12) + pad_left(mebibytes(bytes), 10) +
         "\n";
}

void print_parts(std::span<const MemoryRow> parts, std::ostream& out) {
  for (const MemoryRow& part : parts)
    out << row(part.name + std::string(part.shared ? " *" : ""), part.bytes);
}

}  // namespace

void add_memory_command(Program& program, MemoryOptions& options) {
  Command command = program.add_command("memory", "Show the memory that a measurement reserves at start");
  command.add_option("--width", options.width, "Width of the frames in pixels, default 1600")
      .range(kMinPictureSide, kMaxPictureSide);
  command.add_option("--height", options.height, "Height of the frames in pixels, default 1200")
      .range(kMinPictureSide, kMaxPictureSide);
  command.add_option("--profile", options.profile, "best (default) or paper");
}

int run_memory(const MemoryOptions& options, std::ostream& out) {
  const Profile profile = choose_profile(options.profile);
  out << "Frames of " << options.width << " x " << options.height << " pixels\n\n";
  out << pad_right("part", kPartWidth) << pad_left("bytes", 12) << pad_left("MiB", 10) << "\n";
  const FrameLimits limits{options.width, options.height};
  if (profile == Profile::best) {
    Configuration configuration;
    configuration.limits = limits;
    configuration.network = &food_network();
    print_parts(describe_memory(configuration), out);
    out << row("reserved at start", required_bytes(configuration));
    configuration.network = nullptr;
    out << row("the same where labels are given", required_bytes(configuration));
  } else {
    paper::Configuration configuration;
    configuration.limits = limits;
    print_parts(describe_paper_memory(configuration), out);
    out << row("reserved at start", paper_bytes(configuration));
  }
  out << "* one after the other in the same memory: the largest counts\n\n";
  const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  out << row("beside it: frames, labels", kFrames * kBytesPerPixel * pixels);
  return kExitMeasured;
}

}  // namespace traygauge
