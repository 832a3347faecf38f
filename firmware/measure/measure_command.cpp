#include "firmware/measure/measure_command.hpp"

#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/measure/capture_session.hpp"
#include "firmware/measure/measure_choices.hpp"
#include "firmware/measure/measure_report.hpp"
#include "firmware/measure/mesh_file.hpp"
#include "firmware/measure/missing_card.hpp"
#include "firmware/measure/picture_sheet.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

MeasureReport compose_report(const MeasureOptions& options, const CaptureSession& session,
                             const std::array<int, 2>& pair, std::uint64_t seed,
                             const Measurement& measurement) {
  MeasureReport report;
  report.capture = options.capture;
  report.pair = pair;
  report.profile = name(choose_profile(options.profile));
  report.seed = seed;
  report.message = compose_message(measurement) + explain_missing_card(measurement.status.code(), session);
  report.measurement = &measurement;
  report.pictures = session.pictures();
  report.setup_ms = session.setup_ms();
  report.reserved_bytes = session.reserved_bytes();
  report.used_bytes = session.used_bytes();
  if (session.drawn() != nullptr) report.segmentation_ms = session.drawn()->segmentation.total_ms();
  report.warnings = list_warnings(measurement, session.warnings());
  return report;
}

void write_files(const MeasureOptions& options, const CaptureSession& session, const MeasureReport& report,
                 std::ostream& error) {
  if (!options.picture.empty()) write_picture_sheet(options.picture, report, session);
  if (options.mesh.empty()) return;
  const Measurement& measurement = *report.measurement;
  if (!has_surface(measurement, report.pictures)) {
    error << "traygauge: " << options.mesh << " was not written: no surface was measured\n";
    return;
  }
  const int reference = measurement.views.reference_view;
  write_mesh(options.mesh, compose_mesh(measurement, report.pictures, session.view(reference).picture,
                                        session.lens(reference)));
}

}  // namespace

void add_measure_command(Program& program, MeasureOptions& options) {
  Command command = program.add_command("measure", "Measure the food in two views of a capture");
  command.add_option("capture", options.capture, "Folder with capture.json").required();
  command.add_option("--pair", options.pair, "The two views A,B; default: the first of the capture's pairs");
  command.add_option(
      "--labels", options.labels,
      "Where dish and food are outlined: given (label pictures) or auto (found in the pictures); default: "
      "given where the capture has label pictures");
  add_items_option(command, options.items);
  command.add_option("--profile", options.profile,
                     "best (default), or paper: every stage as the paper describes it");
  command.add_option("--seed", options.seed, "Seed of all randomness, default 0");
  command.add_option("--config", options.config, "Folder with dishes/, for captures that name no dish")
      .environment("TRAYGAUGE_CONFIG");
  command.add_flag("--json", options.json, "Print one JSON document instead of a table");
  command.add_option("--picture", options.picture, "Write a PNG with views, disparity and heights");
  command.add_option("--mesh", options.mesh,
                     "Write the food surface as PLY, in mm over the bottom of the dish");
}

int run_measure(const MeasureOptions& options, std::ostream& out, std::ostream& error) {
  ProfileParameters parameters;
  parameters.profile = choose_profile(options.profile);
  check_label_source(options.labels);
  const std::uint64_t seed = parse_seed(options.seed);
  check_output(options.picture);
  check_output(options.mesh);
  const Capture capture = read_capture(options.capture);
  const std::array<int, 2> pair = choose_pair(options.pair, capture);
  const LabelSource labels = choose_labels(options.labels, capture, pair);
  check_hint(options.items, labels);
  parameters.best.segmentation.items = options.items;
  if (parameters.profile == Profile::paper) require_one_dish(capture);
  CaptureSession session(capture, pair, choose_dishes(capture, options.config), parameters, labels);
  const Measurement& measurement = session.measure(seed);
  const MeasureReport report = compose_report(options, session, pair, seed, measurement);
  write_files(options, session, report, error);
  out << (options.json ? compose_document(report) + "\n" : compose_table(report));
  return is_measured(measurement) ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
