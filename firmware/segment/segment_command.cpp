#include "firmware/segment/segment_command.hpp"

#include <filesystem>
#include <opencv2/core.hpp>
#include <ostream>
#include <system_error>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/capture_session.hpp"
#include "firmware/measure/drawing.hpp"
#include "firmware/measure/measure_choices.hpp"
#include "firmware/measure/missing_card.hpp"
#include "firmware/measure/panels.hpp"
#include "firmware/segment/food_map.hpp"
#include "firmware/segment/segment_report.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

constexpr int kOutlinePanelWidthPx = 1000;

// Both views with what was found, and how probable food is below; where the capture has labels, these as the
// third row.
void write_picture(const std::filesystem::path& file, const CaptureSession& session,
                   const SegmentReport& report, const FoodMap& food) {
  const cv::Size size = panel_size(session.view(0).picture.size, kOutlinePanelWidthPx);
  const bool has_given = report.scores.has_value();
  const int panel_height = size.height + kTitleHeightPx;
  cv::Mat sheet((has_given ? 3 : 2) * panel_height, 2 * size.width, CV_8UC3, kPaper);
  for (int v = 0; v < 2; ++v) {
    const auto at = static_cast<std::size_t>(v);
    const std::string title = "view " + std::to_string(report.pair[at]);
    const auto place = [&](const cv::Mat& panel, int row) {
      panel.copyTo(sheet(cv::Rect({v * size.width, row * panel_height}, panel.size())));
    };
    place(add_title(draw_view(session.view(v), {}, size), title + ", found"), 0);
    const ColourScale scale{0.0, 1.0, ""};
    const cv::Mat probable =
        food.probabilities(at, session.view(v).picture.size)(labelled_part(session.view(v)));
    place(add_title(draw_map(colour_values(probable, scale), scale, size), title + ", probability of food"),
          1);
    if (!has_given) continue;
    LoadedView given = session.view(v);
    given.labels = session.given_labels()[at];
    place(add_title(draw_view(given, {}, size), title + ", given"), 2);
  }
  write_png(file,
            {sheet.data, sheet.cols, sheet.rows, static_cast<std::ptrdiff_t>(sheet.step), PixelFormat::bgr8});
}

void write_labels(const std::filesystem::path& folder, const SegmentReport& report) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!std::filesystem::is_directory(folder)) throw OutputError(folder, "it is no folder");
  for (std::size_t v = 0; v < 2; ++v) {
    write_png(folder / ("labels_" + std::to_string(report.pair[v]) + ".png"),
              report.drawn->labels[v].frame());
  }
}

}  // namespace

void add_segment_command(Program& program, SegmentOptions& options) {
  Command command =
      program.add_command("segment", "Find card, dishes and food in two views of a capture, without labels");
  command.add_option("capture", options.capture, "Folder with capture.json").required();
  command.add_option("--pair", options.pair, "The two views A,B; default: the first of the capture's pairs");
  command.add_option("--config", options.config, "Folder with dishes/, for captures that name no dish")
      .environment("TRAYGAUGE_CONFIG");
  add_items_option(command, options.items);
  command.add_flag("--json", options.json, "Print one JSON document instead of a table");
  command.add_option(
      "--picture", options.picture,
      "Write a PNG with the outlines and the probabilities of food, beside the given outlines");
  command.add_option("--out", options.out,
                     "Folder for labels_A.png and labels_B.png, to correct by hand and to measure with");
}

int run_segment(const SegmentOptions& options, std::ostream& out) {
  check_output(options.picture);
  const Capture capture = read_capture(options.capture);
  const std::array<int, 2> pair = choose_pair(options.pair, capture);
  ProfileParameters parameters;
  parameters.best.segmentation.items = options.items;
  FoodMap food;
  if (!options.picture.empty()) parameters.best.food_observer = &food;
  const CaptureSession session(capture, pair, choose_dishes(capture, options.config), parameters,
                               LabelSource::automatic);
  SegmentReport report;
  report.capture = options.capture;
  report.pair = pair;
  report.drawn = session.drawn();
  const StatusCode status = report.drawn->segmentation.status.code();
  report.message = sentence(status) + explain_missing_card(status, session);
  const auto& given = session.given_labels();
  if (!given[0].pixels.empty() && !given[1].pixels.empty()) {
    report.scores = {score_labels(report.drawn->labels[0], given[0]),
                     score_labels(report.drawn->labels[1], given[1])};
  }
  if (!options.picture.empty()) write_picture(options.picture, session, report, food);
  if (!options.out.empty()) write_labels(options.out, report);
  out << (options.json ? compose_segment_document(report) + "\n" : compose_segment_table(report));
  return report.drawn->segmentation.status.ok() ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
