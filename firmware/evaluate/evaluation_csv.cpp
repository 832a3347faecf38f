#include <sstream>
#include <string>

#include "firmware/base/csv_fields.hpp"
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

std::string list_warnings(const Run& run) {
  std::string list;
  run.warnings.for_each([&](Warning warning, std::uint8_t label) {
    if (!list.empty()) list += ' ';
    list += name(warning);
    if (label != kBackgroundLabel) list.append(":").append(std::to_string(label));
  });
  return list;
}

// Nothing in per cent is an error of a volume of 0.
double error_or_undefined(double volume_ml, const TruthItem& item) {
  return item.volume_ml > 0.0 ? signed_error_percent(volume_ml, item.volume_ml) : kUndefined;
}

std::string estimate_row(const PairRuns& pair, const Run& run, const TruthItem& item) {
  const ItemEstimate* estimate = estimate_of(run, item.label);
  const bool is_measured = estimate != nullptr;
  std::ostringstream row;
  row << csv_field(pair.capture) << ',' << pair.pair[0] << ',' << pair.pair[1] << ',' << run.seed << ','
      << fixed(run.relative_angle_deg, 3) << ',' << item.label << ',' << csv_field(item.name) << ','
      << csv_field(item.kind) << ',' << (is_measured ? "ok" : "refused") << ','
      << (is_measured ? fixed(estimate->volume_ml, 3) : "") << ',' << fixed(item.volume_ml, 3) << ','
      << csv_number(is_measured ? error_or_undefined(estimate->volume_ml, item) : kUndefined, 3) << ','
      << csv_number(item.volume_above_bottom_plane_ml, 3) << ','
      << (is_measured && estimate->sigma_ml > 0.0 ? fixed(estimate->sigma_ml, 3) : "") << ','
      << (is_measured ? fixed(estimate->column_volume_ml, 3) : "") << ','
      << csv_number(item.column_volume_ml, 3) << ',' << (is_measured ? "" : name_of_refusal(run, item.label))
      << ',' << csv_number(pair.true_angle_deg, 3) << ',' << (is_warned(run) ? 1 : 0) << '\n';
  return row.str();
}

// An item's volumes from one pair; of nothing, means are undefined.
std::string pair_row(const PairRuns& pair, const TruthItem& item) {
  std::vector<double> angles;
  std::vector<double> volumes;
  std::vector<double> sigmas;
  for (const Run& run : pair.runs) {
    const ItemEstimate* estimate = estimate_of(run, item.label);
    if (estimate == nullptr) continue;
    angles.push_back(run.relative_angle_deg);
    volumes.push_back(estimate->volume_ml);
    if (estimate->sigma_ml > 0.0) sigmas.push_back(estimate->sigma_ml);
  }
  const double mean_ml = mean(volumes);
  std::ostringstream row;
  row << csv_field(pair.capture) << ',' << pair.pair[0] << ',' << pair.pair[1] << ','
      << csv_number(pair.true_angle_deg.value_or(mean(angles)), 3) << ',' << item.label << ','
      << csv_field(item.name) << ',' << csv_field(item.kind) << ',' << volumes.size() << ','
      << csv_number(mean_ml, 3) << ',' << fixed(item.volume_ml, 3) << ','
      << csv_number(error_or_undefined(mean_ml, item), 3) << ',' << csv_number(mean(sigmas), 3) << '\n';
  return row.str();
}

}  // namespace

std::string compose_estimates_csv(const std::vector<PairRuns>& runs) {
  std::string csv =
      "capture,first,second,seed,angle_deg,label,name,kind,status,volume_ml,truth_ml,signed_error_percent,"
      "truth_above_bottom_plane_ml,sigma_ml,column_volume_ml,column_truth_ml,refusal,true_angle_deg,warned\n";
  for (const PairRuns& pair : runs) {
    for (const Run& run : pair.runs) {
      for (const TruthItem& item : pair.truth.items) csv += estimate_row(pair, run, item);
    }
  }
  return csv;
}

std::string compose_pairs_csv(const std::vector<PairRuns>& runs) {
  std::string csv =
      "capture,first,second,angle_deg,label,name,kind,estimates,mean_ml,truth_ml,signed_error_percent,"
      "sigma_ml\n";
  for (const PairRuns& pair : runs) {
    for (const TruthItem& item : pair.truth.items) csv += pair_row(pair, item);
  }
  return csv;
}

std::string compose_runs_csv(const std::vector<PairRuns>& runs) {
  std::ostringstream csv;
  csv << "capture,first,second,seed,status,angle_deg,keypoints_first,keypoints_second,matches,inliers,"
         "threshold_px,card_tracks,rim_points,rim_height_mm,rows,columns,disparities,matched_fraction,"
         "label_agreement,total_ms,rotation_deg,direction_deg,scale_percent,bottom_tilt_deg,bottom_offset_mm,"
         "table_tilt_deg,table_offset_mm,true_angle_deg,warnings\n";
  for (const PairRuns& pair : runs) {
    for (const Run& run : pair.runs) {
      const MeasurementReport& report = run.report;
      csv << csv_field(pair.capture) << ',' << pair.pair[0] << ',' << pair.pair[1] << ',' << run.seed << ','
          << name(run.status) << ',' << fixed(run.relative_angle_deg, 3) << ',' << report.keypoints[0] << ','
          << report.keypoints[1] << ',' << report.matches << ',' << report.inliers << ','
          << fixed(report.inlier_threshold_px, 3) << ',' << report.card_tracks << ',' << report.rim_points
          << ',' << fixed(report.rim_height_mm, 3) << ',' << report.rectified_rows << ','
          << report.rectified_columns << ',' << report.disparity_range.count() << ','
          << fixed(report.matched_fraction, 4) << ',' << fixed(report.label_agreement, 4) << ','
          << fixed(run.total_ms, 1) << ',' << errors_or_blanks(run.errors) << ','
          << csv_number(pair.true_angle_deg, 3) << ',' << list_warnings(run) << '\n';
    }
  }
  return csv.str();
}

std::string compose_items_csv(const Evaluation& evaluation) {
  std::ostringstream csv;
  csv << "capture,label,name,kind,truth_ml,mean_ml,estimates,refused,mape,bias,cv,cv_seeds,sigma_percent,"
         "within_two_sigma\n";
  for (const ItemEvaluation& item : evaluation.items) {
    const ItemFigures& figures = item.figures;
    csv << csv_field(item.series.capture) << ',' << item.series.label << ',' << csv_field(item.series.name)
        << ',' << (item.series.overhangs ? "scan" : "heightfield") << ',' << fixed(item.series.truth_ml, 3)
        << ',' << csv_number(figures.mean_ml, 3) << ',' << figures.estimates << ',' << figures.refused << ','
        << csv_number(figures.mape, 3) << ',' << csv_number(figures.bias, 3) << ','
        << csv_number(figures.cv, 3) << ',' << csv_number(figures.cv_seeds, 3) << ','
        << csv_number(item.sigma.median_relative_sigma, 3) << ',' << csv_number(item.sigma.coverage, 2)
        << '\n';
  }
  return csv.str();
}

std::string compose_captures_csv(const Evaluation& evaluation) {
  std::ostringstream csv;
  csv << "capture,items,estimates,refused,mape,bias,cv,cv_seeds,within_10,within_20,rotation_deg,"
         "direction_deg,scale_percent,bottom_tilt_deg,bottom_offset_mm,table_tilt_deg,table_offset_mm,ms,"
         "mape_refusals_as_100,pmae,mape_above_bottom_plane,bias_above_bottom_plane\n";
  const auto add = [&](const CaptureEvaluation& capture) {
    const SetFigures& foods = capture.foods;
    const StageFigures& stages = capture.stages;
    csv << csv_field(capture.capture) << ',' << foods.items << ',' << foods.estimates << ',' << foods.refused;
    for (const double value :
         {foods.mape, foods.bias, foods.cv, foods.cv_seeds, foods.within_10, foods.within_20,
          stages.rotation_deg, stages.direction_deg, stages.scale_percent, stages.bottom_tilt_deg,
          stages.bottom_offset_mm, stages.table_tilt_deg, stages.table_offset_mm, stages.time_ms,
          foods.mape_refusals_as_100, foods.pmae, capture.foods_above_plane.mape,
          capture.foods_above_plane.bias}) {
      csv << ',' << csv_number(value, 3);
    }
    csv << '\n';
  };
  for (const CaptureEvaluation& capture : evaluation.captures) add(capture);
  add(evaluation.all);
  return csv.str();
}

}  // namespace traygauge
