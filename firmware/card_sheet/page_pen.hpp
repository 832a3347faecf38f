// Pages of a PDF, drawn in millimetres from their top left corners.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct _cairo;          // NOLINT(bugprone-reserved-identifier): cairo's own
struct _cairo_surface;  // NOLINT(bugprone-reserved-identifier)

namespace traygauge {

struct PagePoint {
  double x_mm = 0.0;
  double y_mm = 0.0;
};

struct PageText {
  double size_mm = 3.2;  // of the font
  bool is_bold = false;
};

class PagePen {
 public:
  // `title` for the reader of the file.
  PagePen(double width_mm, double height_mm, const std::string& title);
  PagePen(const PagePen&) = delete;
  PagePen& operator=(const PagePen&) = delete;
  ~PagePen();

  // All that is drawn is black, unless it is drawn in paper's white.
  void line(PagePoint from, PagePoint to, double width_mm);
  // Strokes and gaps of this length.
  void dashed_line(PagePoint from, PagePoint to, double width_mm, double dash_mm);
  void begin_clip(PagePoint corner, double width_mm, double height_mm);
  void begin_clip(const std::vector<PagePoint>& outline);
  void end_clip();
  // A filled polygon, corner by corner.
  void move_to(PagePoint point);
  void line_to(PagePoint point);
  void fill(bool is_ink);
  // 0 is black, 255 white.
  void fill_gray(int gray);

  // UTF-8. The point is the left end of the first line's base line; lines break where `width_mm` ends.
  // Returns the base line after the last one.
  double write(PagePoint at, const std::string& text, const PageText& style, double width_mm);
  void write_centred(PagePoint middle, const std::string& text, const PageText& style);

  // What is drawn next is on another page of the same size.
  void next_page();
  // Ends the last page. Throws OutputError.
  void save(const std::filesystem::path& file);

 private:
  double width_of(const std::string& text) const;
  void choose(const PageText& style);

  struct Free {
    void operator()(_cairo* context) const;
    void operator()(_cairo_surface* surface) const;
  };
  std::string bytes_;
  std::unique_ptr<_cairo_surface, Free> surface_;
  std::unique_ptr<_cairo, Free> context_;
};

}  // namespace traygauge
