// The dishes that a capture is measured with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

struct StationFile;

// One dish of label 1, or none named: what profile paper measures.
bool has_one_dish(const Capture& capture);
// Throws InputError where it has not.
void require_one_dish(const Capture& capture);

// The capture's dishes, or where it names none, those of the library in the folder `config` (empty: the usual
// one) as candidates for the only dish. Throws InputError.
std::vector<DishDescription> choose_dishes(const Capture& capture, const std::string& config);

// The dishes that a station knows: those in dishes/ beside its file, or where there is none, the usual ones.
// Throws InputError.
std::vector<DishDescription> read_station_dishes(const std::filesystem::path& station_file);

// The dishes of a tray by their styles, each with a label of its own. The failure is the first style that is
// not in `library`.
Expected<std::vector<DishDescription>> find_dishes(const std::vector<std::string>& styles,
                                                   const std::vector<DishDescription>& library);

// Those of `library` that stand on every tray of a station, each with a label of its own; all, as candidates
// for the only dish, where the station names none. Throws InputError.
std::vector<DishDescription> choose_tray_dishes(const StationFile& station,
                                                const std::vector<DishDescription>& library);

}  // namespace traygauge
