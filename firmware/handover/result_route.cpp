#include "firmware/handover/result_route.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "firmware/base/build_info.hpp"
#include "firmware/handover/hub_link.hpp"
#include "firmware/handover/kept_results.hpp"
#include "firmware/handover/scan_handover.hpp"
#include "firmware/journal/posix_file_system.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

KeptResults open_kept(const HandoverConfig& config) {
  constexpr auto kBytesPerMib = std::uint64_t{1024} * 1024;
  std::error_code error;
  std::filesystem::create_directories(config.folder, error);
  if (error) {
    throw InputError({config.folder, ""}, "a folder for results that wait for the hub", error.message(),
                     "make it, or name another");
  }
  Expected<KeptResults> kept = KeptResults::open(
      posix_file_system(),
      {config.folder, config.name, static_cast<std::uint64_t>(config.waiting_mib) * kBytesPerMib});
  if (!kept.ok()) {
    throw InputError({config.folder, ""}, "a folder for results that wait for the hub", kept.failure(),
                     "mend this, or name another");
  }
  return std::move(*kept);
}

HubLinkParams link_params(const HandoverConfig& config) {
  HubLinkParams params;
  params.socket = config.socket;
  params.station = config.name;
  params.program_version = program_version();
  return params;
}

}  // namespace

Nanoseconds repeat_time(const HandoverConfig& config) {
  return std::chrono::round<Nanoseconds>(std::chrono::duration<double>(config.repeat_within_s));
}

struct ResultRoute::Handover {
  Handover(const HandoverConfig& config, StationFacts facts, ScanPrinter& printer, std::ostream& log)
      : kept(open_kept(config)),
        link(link_params(config)),
        sink(printer, link, kept, log, {.facts = std::move(facts), .pictures = config.pictures}) {}

  KeptResults kept;
  HubLink link;
  ScanHandover sink;
};

ResultRoute::ResultRoute(const std::optional<HandoverConfig>& handover, StationFacts facts,
                         ScanPrinter& printer, std::ostream& log)
    : printer_(printer) {
  if (handover) handover_ = std::make_unique<Handover>(*handover, std::move(facts), printer, log);
}

ResultRoute::~ResultRoute() = default;

ResultSink& ResultRoute::sink() const {
  if (handover_ == nullptr) return printer_;
  return handover_->sink;
}

}  // namespace traygauge
