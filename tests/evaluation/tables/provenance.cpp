#include "tests/evaluation/tables/provenance.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "simulator/capture/json_file.hpp"
#include "tests/evaluation/tables/fingerprint.hpp"

namespace traygauge::tables {
namespace {

// As the renderer states it: set and seed.
std::string origin_of(const std::filesystem::path& capture) {
  const JsonDocument document = read_json(capture / "truth.json");
  const nlohmann::json& truth = document.value();
  const auto origin = truth.find("origin");
  if (origin == truth.end() || !origin->is_string()) return "origin not stated";
  return "origin “" + printable(origin->get<std::string>()) + "”";
}

void compose_set(PaperSet set, const std::filesystem::path& folder, int wanted_pairs, std::ostream& text) {
  std::vector<std::string> left_out;
  const auto all = plan_tasks(folder, abilities_of(Profile::best), left_out);
  const auto tasks = spread_out(all, wanted_pairs);
  std::map<std::filesystem::path, int> captures;
  for (const PairTask& task : tasks) ++captures[task.folder];
  std::map<std::string, int> origins;
  for (const auto& [capture, pairs] : captures) ++origins[origin_of(capture)];
  text << "- " << name(set) << ": `" << std::filesystem::absolute(folder).lexically_normal().string() << "`, "
       << captures.size() << " captures, " << tasks.size() << " of " << all.size() << " pairs";
  for (const auto& [origin, count] : origins) text << "; " << count << " of " << origin;
  text << "\n";
}

}  // namespace

std::string compose_provenance(const SetFolders& sets, const RunnerOptions& options,
                               const std::set<std::string>& skipped) {
  std::ostringstream text;
  text << "## What this was computed from\n\n";
  for (const auto& [set, folder] : sets) compose_set(set, folder, options.pairs, text);
  text << "- Seeds 1 to " << options.runs << " of each pair\n- Pictures: " << describe(options.pictures)
       << "\n- Program: " << describe_program() << "\n";
  for (const std::string& reason : skipped) text << "- Left out: " << printable(reason) << "\n";
  text
      << "- Times: " << options.jobs << " pairs at a time (`--jobs " << options.jobs << "`) on a machine of "
      << std::thread::hardware_concurrency()
      << " threads, which slow each other down; results that were in the cache keep the time of the day they "
         "were measured\n\n";
  return text.str();
}

}  // namespace traygauge::tables
