// A capture with two pairs whose rice and peas the fake estimator measures.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/firmware/fake/fake_estimator.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {

class FakeMeal : public testing::Test {
 protected:
  // Of rice the estimator finds `rice_ml`, of peas 50 ml.
  FakeMeal(const std::string& truth, double rice_ml) : items_(2) {
    fake_estimator() = {};
    write_truth(truth);
    items_[0].label = 2;
    items_[0].volume_ml = rice_ml;
    items_[1].label = 3;
    items_[1].volume_ml = 50.0;
    answer(StatusCode::ok);
  }

  void write_truth(const std::string& text) const { write_text(files_.file("truth.json"), text); }

  void answer(StatusCode status) {
    Measurement& measurement = fake_estimator().measurement;
    measurement.status = status;
    measurement.items = items_;
    measurement.relative_angle_deg = 17.0;
    measurement.total_ms = 250.0;
  }

  TemporaryCapture files_;
  std::vector<ItemResult> items_;
};

}  // namespace traygauge
