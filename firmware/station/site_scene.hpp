// What a station knows of its trays from its configuration.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "firmware/config/station_file.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "firmware/station/estimator_measurer.hpp"

namespace traygauge {

class SiteScene final : public Scene {
 public:
  // Reads the card's pattern and the labels, where there are any; throws InputError, also where lens or card
  // are missing, or the station file names a dish that is not in `library`.
  SiteScene(const StationFile& station, std::vector<DishDescription> library);

  const Configuration* configuration() override {
    views_ = 0;
    return &configuration_;
  }
  std::span<const DishModel> dishes(const TrayHint& hint) override;
  ViewInput describe(const StationView& view) override;
  bool needs_labels() const override { return labels_[0].pixels.empty(); }
  std::string_view tray_name() const override { return {}; }
  FrameLimits limits() const { return configuration_.limits; }
  // What a hint may name.
  std::vector<std::string> dish_styles() const;

 private:
  std::vector<DishDescription> library_;
  PairSetup setup_;
  std::array<Picture, 2> labels_;  // empty where they are to be drawn
  Configuration configuration_;    // refers to the setup
  std::vector<DishModel> hinted_;  // dishes of this tray
  std::size_t views_ = 0;          // of this scan
};

}  // namespace traygauge
