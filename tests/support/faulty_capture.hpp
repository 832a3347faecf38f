// Copies of a capture with one thing wrong, for tests of what a measurement makes of them.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge::test {

struct FaultyView {
  cv::Mat3b picture;
  cv::Mat1b labels;
};

// One pair of a capture. The views may be spoilt until store().
class FaultyCapture {
 public:
  FaultyCapture(const std::filesystem::path& original, std::array<int, 2> pair);

  FaultyView& view(int i) { return views_[static_cast<std::size_t>(i)]; }
  // Writes the capture, whose only pair is [0, 1], and returns its folder, which lives as long as this
  // object.
  std::filesystem::path store() const;

 private:
  TemporaryFolder folder_;
  nlohmann::json document_;
  std::array<FaultyView, 2> views_;
};

// Light falls on the sensor before the picture is encoded: blur and gain act on linear light (sRGB).
void defocus(FaultyView& view, double sigma_px);
void shake(FaultyView& view, double length_px, double direction_deg);
void expose(FaultyView& view, double gain);
// Multiplies red by `ratio` and divides blue by it.
void tint(FaultyView& view, double ratio);
void add_noise(FaultyView& view, double sigma, unsigned seed);
// Every item in one colour: the mean of its pixels.
void paint_items_flat(FaultyView& view);
// Something of the table's colour lies over this share of the card, from one of its short sides.
void cover_card(FaultyView& view, double share);
// Both short ends of the card rise off the table: its print moves up the picture there by `rise_px`, between
// them by less.
void bend_card(FaultyView& view, double rise_px);
// Moves the picture until the dish's box sticks out by `px` on the left.
void shift_dish_out(FaultyView& view, int px);
// The item is pushed over the dish.
void move_item(FaultyView& view, int label, cv::Point offset_px);
// The second picture is that of a camera that stood still while the tray was moved: dish and card as the
// second view shows them, on the table of the first.
void keep_table_still(const FaultyView& first, FaultyView& second);

}  // namespace traygauge::test
