// Four markers of a printed page as a reference card.
#pragma once

#include <opencv2/aruco.hpp>
#include <opencv2/core.hpp>

namespace traygauge::test {

// The page of real/fruit_board_*: DICT_7X7_1000, numbered row by row.
inline constexpr int kMarkersAcrossPage = 5;
inline constexpr int kMarkersDownPage = 7;
inline constexpr double kMarkerPitchMm = 40.0;
inline constexpr double kMarkerSideMm = 33.0;
inline constexpr int kCardSideMarkers = 2;

// OpenCV renamed it in 4.7.
void draw_marker(const auto& dictionary, int id, int side_px, cv::Mat& marker) {
#if CV_VERSION_MAJOR > 4 || CV_VERSION_MINOR >= 7
  cv::aruco::generateImageMarker(dictionary, id, side_px, marker);
#else
  cv::aruco::drawMarker(dictionary, id, side_px, marker);
#endif
}

// With half of the gaps around them. `row` and `column` are those of the upper left one.
inline cv::Mat1b draw_marker_card(int row, int column) {
  constexpr int kPxPerMm = 12;
  constexpr int kPitchPx = static_cast<int>(kMarkerPitchMm) * kPxPerMm;
  constexpr int kMarkerPx = static_cast<int>(kMarkerSideMm) * kPxPerMm;
  constexpr int kGapPx = (kPitchPx - kMarkerPx) / 2;
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_7X7_1000);
  cv::Mat1b print(kCardSideMarkers * kPitchPx, kCardSideMarkers * kPitchPx, std::uint8_t{255});
  for (int y = 0; y < kCardSideMarkers; ++y) {
    for (int x = 0; x < kCardSideMarkers; ++x) {
      cv::Mat marker;
      draw_marker(dictionary, kMarkersAcrossPage * (row + y) + column + x, kMarkerPx, marker);
      marker.copyTo(print({x * kPitchPx + kGapPx, y * kPitchPx + kGapPx, kMarkerPx, kMarkerPx}));
    }
  }
  return print;
}

}  // namespace traygauge::test
