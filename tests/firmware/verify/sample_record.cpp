#include "tests/firmware/verify/sample_record.hpp"

namespace traygauge {

VerifyHeader sample_header() {
  VerifyHeader header;
  header.program = "1.2.3";
  header.started = "2026-11-27T07:40:12.345Z";
  header.conditions = {{"camera", "a | b"}, {"temperature", "21 °C"}};
  VerifyPlan& plan = header.plan;
  plan.name = "sample";
  plan.dish = "dinner";
  plan.attempts = 2;
  plan.bodies = {{"a", "C50", "folded", 100.0, 0.0}, {"b", "", "the tester's own", 200.0, 0.0}};
  plan.places = {{"middle", {0.0, 0.0}}, {"left", {-30.0, 10.0}}};
  for (std::size_t body = 0; body < 2; ++body) {
    for (std::size_t place = 0; place < 2; ++place) {
      for (const double angle_deg : {0.0, 45.0}) {
        plan.steps.push_back(
            {plan.bodies[body].id + "-" + plan.places[place].name + "-" + (angle_deg == 0.0 ? "0" : "45"),
             body, place, angle_deg, false});
      }
    }
  }
  for (const char* number : {"01", "02"})
    plan.steps.push_back({std::string("b-repeat-") + number, 1, 0, 0.0, true});
  return header;
}

VerifyScan measured_scan(const std::string& step, double volume_ml, double sigma_ml) {
  VerifyScan scan;
  scan.step = step;
  scan.time = "2026-11-27T07:41:00.000Z";
  scan.status = "ok";
  scan.is_measured = true;
  scan.volume_ml = volume_ml;
  scan.sigma_ml = sigma_ml;
  return scan;
}

VerifyScan refused_scan(const std::string& step) {
  VerifyScan scan;
  scan.step = step;
  scan.time = "2026-11-27T07:41:00.000Z";
  scan.status = "card_not_found";
  scan.message = "The card was not found.";
  return scan;
}

VerifyRecord large_record(const std::vector<double>& error_percent) {
  VerifyRecord record;
  record.header = sample_header();
  VerifyPlan& plan = record.header.plan;
  plan.bodies.clear();
  plan.steps.clear();
  std::size_t turn = 0;
  const auto add = [&](std::size_t body, const std::string& id, bool is_repeat) {
    plan.steps.push_back({id, body, 0, 0.0, is_repeat});
    const double volume_ml = plan.bodies[body].volume_ml;
    const double error = error_percent[turn++ % error_percent.size()];
    record.scans.push_back(measured_scan(id, volume_ml * (1.0 + 0.01 * error), 0.02 * volume_ml));
  };
  for (std::size_t body = 0; body < 5; ++body) {
    const std::string id = "body" + std::to_string(body);
    plan.bodies.push_back({id, "", "exact", 50.0 * static_cast<double>(body + 1), 0.0});
    for (int i = 0; i < 6; ++i) add(body, id + "-" + std::to_string(i), false);
  }
  for (int i = 0; i < 10; ++i) add(2, "repeat-" + std::to_string(i), true);
  return record;
}

}  // namespace traygauge
