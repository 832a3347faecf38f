// What an evaluation looks like on the terminal and in files.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware/evaluate/evaluation.hpp"
#include "tests/firmware/evaluate/sample_runs.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxColumns = 100;

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::size_t count_characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

// Fields of a line, quotes as in RFC 4180.
std::vector<std::string> split_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

// Every row has as many fields as the first one, which names them.
void expect_table(const std::string& csv, std::size_t rows) {
  const std::vector<std::string> lines = split_lines(csv);
  ASSERT_EQ(lines.size(), rows + 1);
  for (const std::string& line : lines)
    EXPECT_EQ(split_fields(line).size(), split_fields(lines[0]).size()) << line;
}

TEST(EvaluationTables, FitATerminal) {
  for (const double sigma_ml : {0.0, 5.0}) {
    const std::string tables = compose_tables(evaluate_sample(sample_runs(sigma_ml)));
    for (const std::string& line : split_lines(tables))
      EXPECT_LE(count_characters(line), kMaxColumns) << line;
    EXPECT_EQ(tables.find("nan"), std::string::npos) << tables;
    EXPECT_EQ(tables.find("not estimated") != std::string::npos, sigma_ml == 0.0);
    EXPECT_NE(tables.find("tray: several dishes"), std::string::npos);
    EXPECT_NE(tables.find("item 2 item_hidden in 1 measurements"), std::string::npos);
    EXPECT_NE(tables.find("två: card_not_found in 1 measurements"), std::string::npos);
  }
}

TEST(EvaluationTables, ManyItemsShowTheWorst) {
  std::vector<PairRuns> runs;
  for (int i = 0; i < 60; ++i) {
    PairRuns pair =
        pair_runs("capture" + std::to_string(100 + i), {{2, "food", "heightfield", 100.0, {}, {}}});
    pair.runs = {measured_run(1, 15.0, {{2, StatusCode::ok, 100.0 + 0.1 * i}})};
    runs.push_back(pair);
  }
  const std::string tables = compose_tables(evaluate_sample(runs));
  EXPECT_NE(tables.find("the 40 worst of 60 items"), std::string::npos);
  const std::string items = tables.substr(tables.find("true ml"));
  EXPECT_NE(items.find("capture159"), std::string::npos);
  EXPECT_EQ(items.find("capture100"), std::string::npos);
  EXPECT_LT(items.find("capture159"), items.find("capture121"));
}

TEST(EvaluationTables, NothingMeasuredIsNoCrash) {
  for (const std::vector<PairRuns>& runs :
       {std::vector<PairRuns>{}, [] {
          PairRuns pair = pair_runs("a", {{2, "food", "heightfield", 100.0, {}, {}}});
          pair.runs = {refused_run(1, StatusCode::pose_not_found)};
          return std::vector{pair};
        }()}) {
    const Evaluation evaluation = evaluate_sample(runs);
    EXPECT_EQ(compose_tables(evaluation).find("nan"), std::string::npos);
    EXPECT_TRUE(Json::parse(compose_summary_json(evaluation))["groups"]["foods"]["mape_percent"].is_null());
  }
}

TEST(EvaluationJson, CarriesTheFigures) {
  const Json document = Json::parse(compose_summary_json(evaluate_sample(sample_runs(5.0))));
  EXPECT_EQ(document["version"], 1);
  EXPECT_EQ(document["measurements"], 10);
  EXPECT_EQ(document["skipped"], Json({"tray: several dishes"}));
  const Json& foods = document["groups"]["foods"];
  EXPECT_EQ(foods["items"], 2);
  EXPECT_EQ(foods["estimates"], 6);
  EXPECT_EQ(foods["refused"], 4);
  EXPECT_NEAR(foods["refused_percent"], 40.0, 1e-12);
  EXPECT_NEAR(foods["mape_percent"], 11.0 / 3.0, 1e-12);  // errors -1, +3, +7 %
  EXPECT_NEAR(foods["mape_refusals_as_100_percent"], 211.0 / 5.0, 1e-12);
  EXPECT_NEAR(foods["bias_percent"], 3.0, 1e-12);
  EXPECT_NEAR(foods["sigma"]["within_two_sigma_percent"], 100.0, 1e-12);
  EXPECT_NEAR(foods["mape_interval_percent"][0], 11.0 / 3.0, 1e-12);
  EXPECT_NEAR(document["groups"]["fruit_closed"]["bias_percent"], 10.0, 1e-12);
  EXPECT_NEAR(document["groups"]["fruit_column"]["bias_percent"], 100.0 / 12.0, 1e-12);
  EXPECT_TRUE(document["groups"]["fruit_column"]["sigma"].is_null()) << "sigma is of volume_ml";
  EXPECT_EQ(document["groups"]["fruit_closed"]["sigma"]["without_sigma"], 2);
  ASSERT_EQ(document["angles"].size(), 1U);
  EXPECT_EQ(document["angles"][0]["low_deg"], 12.5);
  EXPECT_EQ(document["at_15_to_20_deg"]["foods"]["estimates"], 6);
  EXPECT_EQ(document["items"].size(), 4U);
  EXPECT_EQ(document["captures"].size(), 2U);
  EXPECT_EQ(document["refusals"]["två: item 2 item_hidden"], 1);
  EXPECT_EQ(document["refusals"]["två: card_not_found"], 1);
}

TEST(EvaluationJson, SigmaThatIsNotEstimatedIsNull) {
  const Json document = Json::parse(compose_summary_json(evaluate_sample(sample_runs(0.0))));
  EXPECT_TRUE(document["groups"]["foods"]["sigma"].is_null());
  EXPECT_TRUE(document["groups"]["foods"]["within_two_sigma_interval_percent"].is_null());
}

TEST(EvaluationCsv, HasARowForEachAttempt) {
  const std::vector<PairRuns> runs = sample_runs(5.0);
  expect_table(compose_estimates_csv(runs), 20);
  expect_table(compose_pairs_csv(runs), 4);
  expect_table(compose_runs_csv(runs), 10);
  expect_table(compose_items_csv(evaluate_sample(runs)), 4);
  expect_table(compose_captures_csv(evaluate_sample(runs)), 3);
}

// The field of that name in a line.
std::string field_of(const std::string& csv, std::size_t line, const std::string& name) {
  const std::vector<std::string> lines = split_lines(csv);
  const std::vector<std::string> names = split_fields(lines[0]);
  const auto column = std::find(names.begin(), names.end(), name) - names.begin();
  return split_fields(lines.at(line)).at(static_cast<std::size_t>(column));
}

TEST(EvaluationCsv, FieldsAreWhereTheirNamesSay) {
  const std::string csv = compose_estimates_csv(sample_runs(5.0));
  const auto field = [&](std::size_t line, const std::string& name) { return field_of(csv, line, name); };
  EXPECT_EQ(field(1, "capture"), "set, one/a long name that no column will hold");
  EXPECT_EQ(field(1, "volume_ml"), "99.000");
  EXPECT_EQ(field(1, "signed_error_percent"), "-1.000");
  EXPECT_EQ(field(1, "sigma_ml"), "5.000");
  EXPECT_EQ(field(2, "column_volume_ml"), "52.000");
  EXPECT_EQ(field(2, "column_truth_ml"), "48.000");
  EXPECT_EQ(field(7, "status"), "refused");
  EXPECT_EQ(field(7, "refusal"), "item_hidden");
  EXPECT_EQ(field(9, "refusal"), "card_not_found");
  EXPECT_EQ(field(9, "volume_ml"), "");
  EXPECT_EQ(field(9, "signed_error_percent"), "");
}

TEST(EvaluationCsv, PairsHaveMeansOverSeeds) {
  const std::string csv = compose_pairs_csv(sample_runs(5.0));
  EXPECT_EQ(field_of(csv, 1, "estimates"), "3") << "refused by two of five seeds";
  EXPECT_EQ(field_of(csv, 1, "mean_ml"), "103.000");
  EXPECT_EQ(field_of(csv, 1, "signed_error_percent"), "3.000");
  EXPECT_EQ(field_of(csv, 1, "angle_deg"), "16.000") << "as measured: the truth has none";
  EXPECT_EQ(field_of(csv, 2, "estimates"), "4");
  EXPECT_EQ(field_of(csv, 2, "sigma_ml"), "5.000") << "mean over the three seeds that estimated it";
}

TEST(EvaluationCsv, WhatIsUndefinedIsBlank) {
  PairRuns pair =
      pair_runs("a", {{2, "refused", "heightfield", 100.0, {}, {}}, {3, "none", "heightfield", 0.0, {}, {}}});
  pair.true_angle_deg = 21.5;
  pair.runs = {measured_run(1, 15.0, {{2, StatusCode::item_hidden}, {3, StatusCode::ok, 4.0}})};
  const std::string csv = compose_pairs_csv({pair});
  EXPECT_EQ(field_of(csv, 1, "estimates"), "0");
  for (const char* name : {"mean_ml", "signed_error_percent", "sigma_ml"})
    EXPECT_EQ(field_of(csv, 1, name), "") << name;
  EXPECT_EQ(field_of(csv, 1, "angle_deg"), "21.500");
  EXPECT_EQ(field_of(csv, 2, "mean_ml"), "4.000");
  EXPECT_EQ(field_of(csv, 2, "signed_error_percent"), "");
  EXPECT_EQ(field_of(compose_estimates_csv({pair}), 2, "signed_error_percent"), "");
}

}  // namespace
}  // namespace traygauge
