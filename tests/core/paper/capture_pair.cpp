#include "tests/core/paper/capture_pair.hpp"

#include <opencv2/imgproc.hpp>

namespace traygauge::paper {
namespace {

constexpr int kBorder_px = 16;  // around the dish

}  // namespace

WorkingView load_view(const test::CaptureTruth& capture, int index, double dish_pixels) {
  const test::TrueView& view = capture.views.at(static_cast<std::size_t>(index));
  const cv::Mat1b gray = view.read_gray();
  const cv::Mat1b stored_dish = test::dish_mask(view.read_labels());
  const cv::Mat dish = test::Undistortion(view.lens, view.lens.pinhole, stored_dish.size())
                           .apply(stored_dish, cv::INTER_NEAREST);
  const double scale = std::sqrt(dish_pixels / cv::countNonZero(dish));
  const cv::Rect box = cv::boundingRect(dish);
  const cv::Point corner(static_cast<int>(scale * box.x) - kBorder_px,
                         static_cast<int>(scale * box.y) - kBorder_px);
  const cv::Size size(static_cast<int>(scale * box.width) + 2 * kBorder_px,
                      static_cast<int>(scale * box.height) + 2 * kBorder_px);
  WorkingView result;
  result.camera = test::enlarge(view.lens.pinhole, scale);
  result.camera.cx_px -= corner.x;
  result.camera.cy_px -= corner.y;
  const test::Undistortion working(view.lens, result.camera, size);
  cv::Mat smooth;
  cv::GaussianBlur(gray, smooth, {}, 0.5 / scale);  // against aliasing
  result.gray = working.apply(smooth, cv::INTER_CUBIC);
  result.region = working.apply(stored_dish, cv::INTER_NEAREST) / 255;
  if (index == 0) result.depth = working.apply(capture.read_depth_mm(), cv::INTER_LINEAR);
  result.camera_from_world = view.camera_from_world;
  return result;
}

}  // namespace traygauge::paper
