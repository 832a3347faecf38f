#include "firmware/card_sheet/page_pen.hpp"

#include <cairo-pdf.h>

#include <cerrno>
#include <cstdio>
#include <sstream>

#include "simulator/capture/output_file.hpp"

namespace traygauge {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kLineSpacing = 1.35;  // of the font's size

cairo_status_t append(void* text, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

void PagePen::Free::operator()(cairo_t* context) const {
  cairo_destroy(context);
}

void PagePen::Free::operator()(cairo_surface_t* surface) const {
  cairo_surface_destroy(surface);
}

PagePen::PagePen(double width_mm, double height_mm, const std::string& title)
    : surface_(cairo_pdf_surface_create_for_stream(append, &bytes_, kPointsPerMm * width_mm,
                                                   kPointsPerMm * height_mm)),
      context_(cairo_create(surface_.get())) {
  cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  cairo_scale(context_.get(), kPointsPerMm, kPointsPerMm);
}

PagePen::~PagePen() = default;

void PagePen::line(PagePoint from, PagePoint to, double width_mm) {
  cairo_set_source_rgb(context_.get(), 0.0, 0.0, 0.0);
  cairo_set_line_width(context_.get(), width_mm);
  move_to(from);
  line_to(to);
  cairo_stroke(context_.get());
}

void PagePen::dashed_line(PagePoint from, PagePoint to, double width_mm, double dash_mm) {
  cairo_set_dash(context_.get(), &dash_mm, 1, 0.0);
  line(from, to, width_mm);
  cairo_set_dash(context_.get(), nullptr, 0, 0.0);
}

void PagePen::begin_clip(const std::vector<PagePoint>& outline) {
  cairo_save(context_.get());
  cairo_new_path(context_.get());
  for (const PagePoint& corner : outline) line_to(corner);
  cairo_close_path(context_.get());
  cairo_clip(context_.get());
}

void PagePen::begin_clip(PagePoint corner, double width_mm, double height_mm) {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), corner.x_mm, corner.y_mm, width_mm, height_mm);
  cairo_clip(context_.get());
}

void PagePen::end_clip() {
  cairo_restore(context_.get());
}

void PagePen::move_to(PagePoint point) {
  cairo_move_to(context_.get(), point.x_mm, point.y_mm);
}

void PagePen::line_to(PagePoint point) {
  cairo_line_to(context_.get(), point.x_mm, point.y_mm);
}

void PagePen::fill(bool is_ink) {
  fill_gray(is_ink ? 0 : 255);
}

void PagePen::fill_gray(int gray) {
  const double light = gray / 255.0;
  cairo_set_source_rgb(context_.get(), light, light, light);
  cairo_fill(context_.get());
}

void PagePen::choose(const PageText& style) {
  cairo_set_source_rgb(context_.get(), 0.0, 0.0, 0.0);
  cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         style.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), style.size_mm);
}

double PagePen::width_of(const std::string& text) const {
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

double PagePen::write(PagePoint at, const std::string& text, const PageText& style, double width_mm) {
  choose(style);
  const auto show = [&](const std::string& line) {
    move_to(at);
    cairo_show_text(context_.get(), line.c_str());
    at.y_mm += kLineSpacing * style.size_mm;
  };
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) {
    const std::string before = line;
    if (!line.empty()) line += ' ';
    line += word;
    if (before.empty() || width_of(line) <= width_mm) continue;
    show(before);
    line = word;
  }
  if (!line.empty()) show(line);
  return at.y_mm;
}

void PagePen::write_centred(PagePoint middle, const std::string& text, const PageText& style) {
  choose(style);
  move_to({middle.x_mm - 0.5 * width_of(text), middle.y_mm});
  cairo_show_text(context_.get(), text.c_str());
}

void PagePen::next_page() {
  cairo_show_page(context_.get());
}

void PagePen::save(const std::filesystem::path& file) {
  cairo_show_page(context_.get());
  cairo_surface_finish(surface_.get());
  cairo_status_t status = cairo_status(context_.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
  if (status != CAIRO_STATUS_SUCCESS) throw OutputError(file, cairo_status_to_string(status));
  write_stream(file, [this](std::FILE* stream) {
    return std::fwrite(bytes_.data(), 1, bytes_.size(), stream) == bytes_.size();
  });
}

}  // namespace traygauge
