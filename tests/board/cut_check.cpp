// After a power cut: whether the store has what the station's lamp told of, once. Usage: cut_check STORE TOLD
// TOLD has a line for each: "done NAME" or "kept NAME". Prints a line "FAIL …" for each tray that is lost or
// stored twice, for damage of the store and for a scan that was set aside, whose number had been given
// before; then how many scans are stored.
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "firmware/store/open_store.hpp"

namespace {

using namespace traygauge;

int failures = 0;

void fail(const std::string& text) {
  constexpr int kMostLines = 20;
  if (++failures <= kMostLines) std::cout << "FAIL " << text << std::endl;
}

// How often each tray is stored.
std::map<std::string, int> count_trays(Store& store) {
  std::map<std::string, int> counts;
  const Expected<void> read = store.history().for_each({}, [&](const StoredScan& scan) {
    ++counts[nlohmann::json::parse(scan.document).at("tray").get<std::string>()];
    return true;
  });
  if (!read.ok()) fail(read.failure());
  return counts;
}

void check(Store& store, const std::string& told) {
  const std::map<std::string, int> counts = count_trays(store);
  int lost = 0;
  int doubled = 0;
  for (const auto& [tray, count] : counts) {
    if (count <= 1) continue;
    ++doubled;
    fail(tray + ": stored " + std::to_string(count) + " times");
  }
  std::ifstream lines(told);
  if (!lines) fail(told + ": unreadable");
  for (std::string signal, tray; lines >> signal >> tray;) {
    if (counts.contains(tray)) continue;
    ++lost;
    fail(tray + ": lost, and it had been told as " + signal);
  }
  const Expected<StoreTotals> totals = store.scans().totals();
  if (!totals.ok()) {
    fail(totals.failure());
  } else if (totals->counts.set_aside > 0) {
    fail(std::to_string(totals->counts.set_aside) + " scans were set aside: a number came twice");
  }
  std::cout << "STORED " << counts.size() << " " << lost << " " << doubled << std::endl;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::cerr << "usage: cut_check STORE TOLD" << std::endl;
    return 2;
  }
  StoreOptions options;
  options.file = arguments[1];
  const Expected<OpenedStore> opened = open_store(options, read_wall_clock());
  if (!opened.ok()) {
    fail(opened.failure());
    return 1;
  }
  for (const std::string& notice : opened->notices) fail(notice);
  check(*opened->store, arguments[2]);
  return failures > 0 ? 1 : 0;
}
