#include "firmware/calibrate/chessboard.hpp"

#include <algorithm>
#include <opencv2/calib3d.hpp>

namespace traygauge {
namespace {

// Twice the area of the outline through the corner points, positive when it runs clockwise in the picture.
double turn_of(const std::vector<Vec2>& corners, const Chessboard& board) {
  const auto last = static_cast<std::size_t>(board.columns - 1);
  const Vec2 along = corners[last] - corners.front();
  const Vec2 down = corners[corners.size() - 1 - last] - corners.front();
  return along.x() * down.y() - along.y() * down.x();
}

}  // namespace

// findChessboardCornersSB orders the corners as it likes: frames of one board may begin at opposite ends, and
// boards seen at a slant were reported with rows reversed.
bool find_chessboard(ImageView<const std::uint8_t> gray, const Chessboard& board, BoardSighting& sighting) {
  const cv::Mat picture(gray.height, gray.width, CV_8UC1, const_cast<std::uint8_t*>(gray.data),
                        static_cast<std::size_t>(gray.stride));
  std::vector<cv::Point2f> corners;
  const int flags = cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY;
  const bool found =
      cv::findChessboardCornersSB(picture, cv::Size(board.columns, board.rows), corners, flags);
  sighting.corners_px.clear();
  if (!found || corners.size() != board.corner_count()) return false;
  for (const cv::Point2f& corner : corners) sighting.corners_px.emplace_back(corner.x, corner.y);
  if (turn_of(sighting.corners_px, board) < 0.0) {
    for (auto row = sighting.corners_px.begin(); row != sighting.corners_px.end(); row += board.columns)
      std::reverse(row, row + board.columns);
  }
  return true;
}

}  // namespace traygauge
