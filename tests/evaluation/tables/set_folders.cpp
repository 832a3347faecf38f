#include "tests/evaluation/tables/set_folders.hpp"

#include <array>

#include "firmware/base/exit_status.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge::tables {
namespace {

struct Choice {
  PaperSet set;
  const char* option;
  std::string SetOptions::*folder;
};

constexpr std::array<Choice, kPaperSets> kChoices = {{{PaperSet::meals, "meals", &SetOptions::meals},
                                                      {PaperSet::angles, "angles", &SetOptions::angles},
                                                      {PaperSet::plates, "plates", &SetOptions::plates},
                                                      {PaperSet::meals14, "meals14", &SetOptions::meals14}}};

void require_folder(const std::string& option, const std::filesystem::path& folder) {
  if (std::filesystem::is_directory(folder)) return;
  throw UsageError("--" + option + " " + printable(folder.string()) +
                   ": there is no such folder; name one that holds captures");
}

}  // namespace

SetFolders find_sets(const SetOptions& options) {
  SetFolders folders;
  if (!options.sets.empty()) require_folder("sets", options.sets);
  for (const Choice& choice : kChoices) {
    const std::string& named = options.*choice.folder;
    if (!named.empty()) {
      require_folder(choice.option, named);
      folders[choice.set] = named;
      continue;
    }
    if (options.sets.empty()) continue;
    for (const char* below : {name(choice.set), choice.option}) {
      const std::filesystem::path folder = std::filesystem::path(options.sets) / below;
      if (std::filesystem::is_directory(folder)) folders.try_emplace(choice.set, folder);
    }
  }
  return folders;
}

}  // namespace traygauge::tables
