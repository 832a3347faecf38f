#include <sstream>
#include <string>

#include "firmware/base/text.hpp"
#include "firmware/evaluate/evaluation.hpp"

namespace traygauge {
namespace {

std::string errors_or_blanks(const std::optional<StageErrors>& errors) {
  if (!errors) return ",,,,,,";
  std::string text = fixed(errors->rotation_deg, 4);
  for (const double value : {errors->direction_deg, errors->scale_percent, errors->bottom_tilt_deg,
                             errors->bottom_offset_mm, errors->table_tilt_deg, errors->table_offset_mm}) {
    text += ',' + fixed(value, 4);
  }
  return text;
}

}  // namespace

std::string compose_estimates_csv(const std::vector<PairRuns>& runs) {
  std::ostringstream csv;
  csv << "capture,first,second,seed,angle_deg,label,name,kind,status,volume_ml,truth_ml,truth_above_bottom_"
         "plane_ml\n";
  for (const PairRuns& pair : runs) {
    for (const Run& run : pair.runs) {
      for (const TruthItem& item : pair.truth.items) {
        csv << pair.capture << ',' << pair.pair[0] << ',' << pair.pair[1] << ',' << run.seed << ','
            << fixed(run.relative_angle_deg, 3) << ',' << item.label << ',' << item.name << ',' << item.kind
            << ',';
        const auto estimate = estimate_of(run, item.label);
        csv << (estimate ? "ok" : "refused") << ',' << (estimate ? fixed(*estimate, 3) : "") << ','
            << fixed(item.volume_ml, 3) << ','
            << (item.volume_above_bottom_plane_ml ? fixed(*item.volume_above_bottom_plane_ml, 3) : "")
            << '\n';
      }
    }
  }
  return csv.str();
}

std::string compose_runs_csv(const std::vector<PairRuns>& runs) {
  std::ostringstream csv;
  csv << "capture,first,second,seed,status,angle_deg,keypoints_first,keypoints_second,matches,inliers,"
         "threshold_px,"
         "card_tracks,rim_points,rim_height_mm,rows,columns,disparities,matched_share,label_agreement,total_"
         "ms,"
         "rotation_deg,direction_deg,scale_percent,bottom_tilt_deg,bottom_offset_mm,table_tilt_deg,table_"
         "offset_mm\n";
  for (const PairRuns& pair : runs) {
    for (const Run& run : pair.runs) {
      const MeasurementReport& report = run.report;
      csv << pair.capture << ',' << pair.pair[0] << ',' << pair.pair[1] << ',' << run.seed << ','
          << name(run.status) << ',' << fixed(run.relative_angle_deg, 3) << ',' << report.keypoints[0] << ','
          << report.keypoints[1] << ',' << report.matches << ',' << report.inliers << ','
          << fixed(report.inlier_threshold_px, 3) << ',' << report.card_tracks << ',' << report.rim_points
          << ',' << fixed(report.rim_height_mm, 3) << ',' << report.rectified_rows << ','
          << report.rectified_columns << ',' << report.disparity_range.count() << ','
          << fixed(report.matched_share, 4) << ',' << fixed(report.label_agreement, 4) << ','
          << fixed(run.total_ms, 1) << ',' << errors_or_blanks(run.errors) << '\n';
    }
  }
  return csv.str();
}

}  // namespace traygauge
