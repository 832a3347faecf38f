// Scalable Vector Graphics 1.1, written element by element.
#pragma once

#include <string>
#include <vector>

namespace traygauge {

struct SvgPoint {
  double x = 0.0;  // px, to the right
  double y = 0.0;  // px, downwards
};

struct Stroke {
  const char* colour = "#000000";
  double width_px = 1.0;
  const char* dashes = "";  // lengths of dash and gap; empty: solid
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size_px = 13.0;
  const char* colour = "#222222";
  Anchor anchor = Anchor::start;
  bool is_bold = false;
  bool is_upright = false;  // read from below to above
};

class Svg {
 public:
  // On white.
  Svg(int width_px, int height_px);

  void rectangle(SvgPoint top_left, double width_px, double height_px, const char* colour,
                 double opacity = 1.0);
  void circle(SvgPoint centre, double radius_px, const char* colour, double opacity = 1.0);
  void line(SvgPoint from, SvgPoint to, const Stroke& stroke);
  void polyline(const std::vector<SvgPoint>& points, const Stroke& stroke);
  // `position` is on the baseline.
  void text(SvgPoint position, const std::string& text, const TextStyle& style = {});

  // The whole document.
  std::string str() const;

 private:
  int width_px_;
  int height_px_;
  std::string elements_;
};

// With the characters that XML reserves or forbids replaced.
std::string escape_xml(const std::string& text);

}  // namespace traygauge
