#include "firmware/collect/collect_command.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <ostream>
#include <vector>

#include "firmware/base/exit_status.hpp"
#include "firmware/collect/collector.hpp"
#include "firmware/command/program.hpp"

namespace traygauge {

void add_collect_options(Program& program, CollectCommand& command) {
  Command collect = program.add_command("collect", "Store what many hubs publish, and give them receipts");
  collect.add_option("CONFIG", command.config, "The collector's file; see config/collector.toml").required();
  collect.add_flag("--check", command.only_check,
                   "Only say whether the file and what it names are as expected");
}

int run_collect(const CollectCommand& command, const std::atomic<bool>& stop, std::ostream& out,
                std::ostream& log) {
  const CollectConfig config = read_collect_config(command.config);
  const Expected<std::unique_ptr<Collector>> started = Collector::start(config);
  if (!started.ok()) throw UsageError(command.config + ": " + started.failure());
  Collector& collector = **started;
  const Expected<std::int64_t> count = collector.store().count();
  if (!count.ok()) throw UsageError(command.config + ": store: " + count.failure());
  if (command.only_check) {
    out << command.config << ": as expected for a collector; " << config.store.shown() << " has " << *count
        << " results." << std::endl;
    return kExitMeasured;
  }
  out << "The collector stores what hubs publish at " << config.broker.shown() << " in "
      << config.store.shown() << ", which has " << *count << " results." << std::endl;
  if (const std::string warning = collector.warning(); !warning.empty()) log << warning << std::endl;
  std::vector<pollfd> descriptors;
  while (!stop) {
    // A signal interrupts the wait, but for one that comes just before it.
    constexpr std::chrono::milliseconds kLongestWait{500};
    descriptors.clear();
    collector.add_descriptors(descriptors);
    const auto wait = std::min(kLongestWait, collector.timeout());
    ::poll(descriptors.data(), descriptors.size(), static_cast<int>(wait.count()));
    for (const std::string& sentence : collector.attend()) log << sentence << std::endl;
  }
  const CollectorCounts& counts = collector.counts();
  out << "Stored " << counts.stored << " results; " << counts.repeated << " came again, " << counts.ignored
      << " messages were no results." << std::endl;
  return kExitMeasured;
}

}  // namespace traygauge
