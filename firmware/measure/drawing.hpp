// Small things to draw with: text, colour scales, panels with a title.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

namespace traygauge {

inline constexpr int kTitleHeightPx = 34;
// NOLINTBEGIN(readability-identifier-naming): constants; this type cannot be constexpr
inline const cv::Scalar kInk(235, 235, 235);
inline const cv::Scalar kPaper(32, 32, 32);
inline const cv::Scalar kUnknownColour(60, 56, 52);
// NOLINTEND(readability-identifier-naming)

// ASCII text, outlined so that it can be read on any picture; `origin` is the left end of its base line.
void draw_text(cv::Mat& image, const std::string& text, cv::Point origin, double scale,
               const cv::Scalar& colour);
cv::Size measure_text(const std::string& text, double scale);

// The panel below a line with its title.
cv::Mat add_title(const cv::Mat& panel, const std::string& title);

// A panel that says why there is nothing to show.
cv::Mat draw_missing(cv::Size size, const std::string& reason);

// `picture` as large as it fits, in the middle of a panel of `background`.
cv::Mat fit(const cv::Mat& picture, cv::Size size, int interpolation, const cv::Scalar& background);

// What numbers look like.
struct ColourScale {
  double low = 0.0;
  double high = 1.0;
  std::string unit;
};

// Where `values` (float) are not NaN: 255.
cv::Mat known_pixels(const cv::Mat& values);

// `values` (float, NaN where unknown) in colour; the unknown is dark.
cv::Mat colour_values(const cv::Mat& values, const ColourScale& scale);

// `map` with the bar of its scale at the right, in a panel of `size`.
cv::Mat draw_map(const cv::Mat& map, const ColourScale& scale, cv::Size size);

// The range that all but the outermost `share` at each end of the known values span; false when none is
// known.
bool spanned_range(const cv::Mat& values, double share, double& low, double& high);

// A colour (BGR) that tells a label from its neighbours.
cv::Scalar label_colour(std::uint8_t label);

}  // namespace traygauge
