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
  // Reads the card's pattern and the labels, where there are any; throws InputError, also where lens or card
  // are missing. `dishes`: those of a tray, or candidates for its only one.
  SiteScene(const StationFile& station, const std::vector<DishDescription>& dishes);

  const Configuration* configuration() override {
    views_ = 0;
    return &configuration_;
  }
  ViewInput describe(const StationView& view) override;
  bool needs_labels() const override { return labels_[0].pixels.empty(); }
  std::string_view tray_name() const override { return {}; }
  FrameLimits limits() const { return configuration_.limits; }

 private:
  PairSetup setup_;
  std::array<Picture, 2> labels_;  // empty where they are to be drawn
  Configuration configuration_;    // refers to the setup
  std::size_t views_ = 0;          // of this scan
};

}  // namespace traygauge
