#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/calibrate/calibrate_command.hpp"
#include "firmware/calibrate/lens_calibration.hpp"
#include "firmware/config/station_writing.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr int kMinCorners = 3;
constexpr int kMaxCorners = 50;

int read_count(const std::string& text, std::size_t begin, std::size_t end) {
  int count = 0;
  const char* const last = text.data() + end;
  const auto [stop, error] = std::from_chars(text.data() + begin, last, count);
  return error == std::errc() && stop == last ? count : 0;
}

Chessboard read_board(const std::string& text) {
  const std::size_t cross = std::min(text.find('x'), text.size());
  Chessboard board;
  board.columns = read_count(text, 0, cross);
  board.rows = cross < text.size() ? read_count(text, cross + 1, text.size()) : 0;
  const auto is_count = [](int count) { return count >= kMinCorners && count <= kMaxCorners; };
  if (!is_count(board.columns) || !is_count(board.rows)) {
    throw UsageError("--board: expected inner corners such as 9x6, 3 to 50 each way, found " +
                     printable(text));
  }
  return board;
}

bool is_picture(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".jpg" || ending == ".jpeg" || ending == ".png";
}

std::vector<fs::path> list_pictures(const std::vector<std::string>& inputs) {
  std::vector<fs::path> files;
  for (const fs::path input : inputs) {
    if (!fs::is_directory(input)) {
      files.push_back(input);
      continue;
    }
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(input)) {
      if (is_picture(entry.path())) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::array<char, 16> text{};
  std::tm day{};
  gmtime_r(&now, &day);
  std::strftime(text.data(), text.size(), "%Y-%m-%d", &day);
  return text.data();
}

std::vector<BoardSighting> find_boards(const std::vector<fs::path>& files, const Chessboard& board,
                                       PictureSize size, std::ostream& out) {
  std::vector<BoardSighting> sightings;
  for (const fs::path& file : files) {
    const Picture picture = to_gray(read_picture({file, ""}, size));
    BoardSighting sighting{file.string(), {}};
    const bool found = find_chessboard(picture.gray(), board, sighting);
    out << printable(file.string()) << (found ? ": board found" : ": no board; it is left out") << std::endl;
    if (found) sightings.push_back(std::move(sighting));
  }
  return sightings;
}

std::string summary_of(const LensCalibration& lens) {
  return std::to_string(lens.pictures) + " pictures, corners within " + fixed(lens.rms_px, 3) + " px, " +
         fixed(lens.held_out_rms_px, 3) + " px in pictures left out of the fit; boards in " +
         fixed(100.0 * lens.covered_fraction, 0) + " % of the picture, facing up to " +
         fixed(lens.facing_spread_deg, 0) + " degrees apart";
}

}  // namespace

int run_calibrate_lens(const CalibrateOptions& options, std::ostream& out) {
  const Chessboard board = read_board(options.board);
  const StationFile station = read_station_file(options.station);
  if (options.second && !station.second_camera) {
    throw UsageError("--second: " + printable(options.station) + " has no [second_camera]");
  }
  const V4l2CameraParams& camera = options.second ? *station.second_camera : station.camera;
  const PictureSize size{camera.mode.width, camera.mode.height};
  const auto sightings = find_boards(list_pictures(options.inputs), board, size, out);
  LensCalibrationParams params;
  if (station.arm) params.meal.second_view_deg = std::abs(station.arm->second_view_deg);
  LensCalibration calibration;
  CalibrationProblem problem;
  if (!calibrate_lens(sightings, board, size, params, calibration, problem)) {
    throw InputError({options.inputs.front(), ""}, problem.expected, problem.found, problem.hint);
  }
  for (const std::string& picture : calibration.left_out)
    out << printable(picture) << ": its corners do not fit the others'; it is left out" << std::endl;
  const std::string name = options.second ? "second_lens" : "lens";
  // As it is shown.
  const double percent = std::round(calibration.volume_percent * 100.0) / 100.0;
  const std::string grade = "grade: volumes right to " + fixed(calibration.volume_percent, 2) +
                            " % (two sigma) as far as the lens goes";
  out << summary_of(calibration) << "\n" << grade << "\n";
  LensConfig lens{calibration.camera, {}, camera.device, today(), {}, {}};
  if (percent <= kMaxGradePercent) lens.grade_percent = percent;
  const ControlWish& focus = camera.controls[static_cast<std::size_t>(CameraControl::focus)];
  if (focus.kind == ControlWish::Kind::value) {
    lens.focus = focus.value;
  } else {
    out << "Set camera.focus to a number where the camera can focus: a lens that focuses anew at every start "
           "is "
           "another lens.\n";
  }
  const std::string table = compose_lens_table(name, lens, summary_of(calibration) + "\n" + grade);
  out << "\n" << table << "\n";
  const bool is_good = calibration.volume_percent <= params.max_volume_percent;
  if (!is_good) {
    out << "More than " << fixed(params.max_volume_percent, 2)
        << " % is not good enough: take more and sharper pictures, a flat board near, far, tilted and in the "
           "picture's corners.\n";
  }
  if (!options.dry_run && (is_good || options.force)) {
    write_station_table(options.station, name, table);
    out << "Written to " << printable(options.station) << std::endl;
  }
  return is_good ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
