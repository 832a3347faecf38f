#include "firmware/measure/picture_sheet.hpp"

#include <opencv2/core.hpp>
#include <string>

#include "firmware/base/text.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/measure/drawing.hpp"
#include "firmware/measure/panels.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

constexpr int kPanelWidthPx = 800;
constexpr int kGapPx = 8;
constexpr double kHeadScale = 0.7;

std::string headline(const MeasureReport& report) {
  const Measurement& measurement = *report.measurement;
  std::string text = report.capture + "   " + name(measurement.status.code());
  if (measurement.has_pose) text += "   " + fixed(measurement.relative_angle_deg, 1) + " degrees apart";
  if (measurement.total_ms > 0.0) text += "   " + fixed(measurement.total_ms, 0) + " ms";
  return text;
}

std::string view_title(const MeasureReport& report, int view) {
  const bool is_reference = report.pictures != nullptr && !report.pictures->depth_mm.empty() &&
                            report.measurement->views.reference_view == view;
  return "view " + std::to_string(report.pair[static_cast<std::size_t>(view)]) +
         (is_reference ? " (reference)" : "");
}

}  // namespace

void write_picture_sheet(const std::filesystem::path& file, const MeasureReport& report,
                         const CaptureSession& session) {
  const cv::Size size = panel_size(session.view(0).picture.size, kPanelWidthPx);
  const Measurement& measurement = *report.measurement;
  const bool is_paper = report.profile != name(Profile::best);
  const cv::Mat panels[] = {
      add_title(draw_view(session.view(0), measurement, size), view_title(report, 0)),
      add_title(draw_view(session.view(1), measurement, size), view_title(report, 1)),
      is_paper ? add_title(draw_disparity(report, size), "disparity of the rectified views")
               : add_title(draw_evidence(report, size), "from above: dark where no view sees it"),
      is_paper ? add_title(draw_heights(report, size), "height over the bottom of the dish")
               : add_title(draw_food_heights(report, size), "height of the food over the dish"),
  };
  const int panel_height = size.height + kTitleHeightPx;
  cv::Mat sheet(kTitleHeightPx + 2 * panel_height + kGapPx, 2 * size.width + kGapPx, CV_8UC3, kPaper);
  for (int i = 0; i < 4; ++i) {
    const cv::Point corner((i % 2) * (size.width + kGapPx),
                           kTitleHeightPx + (i / 2) * (panel_height + kGapPx));
    panels[i].copyTo(sheet(cv::Rect(corner, panels[i].size())));
  }
  draw_text(sheet, headline(report), {4, kTitleHeightPx - 10}, kHeadScale, kInk);
  write_png(file,
            {sheet.data, sheet.cols, sheet.rows, static_cast<std::ptrdiff_t>(sheet.step), PixelFormat::bgr8});
}

}  // namespace traygauge
