// What a station knows of its trays from its configuration.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/config/station_file.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "firmware/station/estimator_measurer.hpp"

namespace traygauge {

class SiteScene final : public Scene {
 public:
  // Reads the card's pattern and the labels; throws InputError, also where lens, card or labels are missing.
  // `dishes`: candidates for the only dish of a tray.
  SiteScene(const StationFile& station, const std::vector<DishDescription>& dishes, Profile profile);

  const Configuration* configuration() override {
    views_ = 0;
    return &configuration_;
  }
  ViewInput describe(const StationView& view) override;
  std::string_view tray_name() const override { return {}; }
  EstimatorLimits limits() const { return configuration_.limits; }

 private:
  PairSetup setup_;
  std::array<Picture, 2> labels_;
  Configuration configuration_;  // refers to the setup
  std::size_t views_ = 0;        // of this scan
};

}  // namespace traygauge
