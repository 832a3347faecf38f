// A capture of the demo as an estimator is given it.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/network/network_file.hpp"
#include "core/pipeline/configuration.hpp"
#include "core/pipeline/view_input.hpp"
#include "simulator/capture/capture.hpp"
#include "simulator/capture/input_bytes.hpp"

namespace traygauge {

class DemoTray {
 public:
  DemoTray() : DemoTray(std::filesystem::path(TRAYGAUGE_SOURCE_DIR "/simulator/demo")) {}
  // From a folder with the demo's captures.
  explicit DemoTray(const std::filesystem::path& demo)
      : DemoTray(read_capture(demo / "mash_and_meatballs")) {}

  template <class Config = Configuration>
  Config configuration() const {
    Config configuration;
    static_cast<TraySetup&>(configuration) = setup_;
    if constexpr (requires { configuration.network; }) configuration.network = &network_;
    return configuration;
  }
  // With its labels.
  ViewInput view(std::size_t i) const { return {views_[i].picture.frame(), views_[i].labels.gray(), {}, {}}; }
  // Without.
  ViewInput bare_view(std::size_t i) const { return {views_[i].picture.frame(), {}, {}, {}}; }

 private:
  explicit DemoTray(const Capture& capture) : pattern_(load_pattern(capture.card)) {
    const NetworkFileStatus status = parse_network(std::as_bytes(std::span(network_file_)), network_);
    EXPECT_EQ(status, NetworkFileStatus::ok);
    for (std::size_t i = 0; i < 2; ++i) views_[i] = load_view(capture.views[i]);
    const CameraDescription& camera = capture.views[0].camera;
    const auto& [k1, k2, p1, p2, k3] = camera.distortion;
    setup_.lens = {camera.size.width, camera.size.height, {}, k1, k2, p1, p2, k3};
    setup_.lens.pinhole = {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px};
    setup_.card = {{capture.card.width_mm, capture.card.height_mm, capture.card.thickness_mm},
                   pattern_.gray()};
    const DishDescription& dish = capture.dishes.front();
    dishes_[0] = {dish.outer_size_mm, dish.rim_height_mm, dish.bottom_height_mm};
    setup_.dishes = dishes_;
    setup_.limits = {camera.size.width, camera.size.height};
  }

  std::vector<std::uint8_t> network_file_ =
      read_bytes({TRAYGAUGE_SOURCE_DIR "/config/network/food.tgn", ""}, kMaxNetworkFileBytes, "a network");
  Network network_;  // refers to it
  Picture pattern_;
  std::array<LoadedView, 2> views_;
  std::array<DishModel, 1> dishes_;
  TraySetup setup_;
};

}  // namespace traygauge
