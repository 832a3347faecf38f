#include "firmware/plot/svg.hpp"

#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

constexpr int kDecimals = 2;

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string attribute(const char* name, double value) {
  return attribute(name, fixed(value, kDecimals));
}

std::string stroke_attributes(const Stroke& stroke) {
  std::string text = attribute("stroke", stroke.colour) + attribute("stroke-width", stroke.width_px);
  if (*stroke.dashes != '\0') text += attribute("stroke-dasharray", stroke.dashes);
  return text;
}

const char* name(Anchor anchor) {
  if (anchor == Anchor::middle) return "middle";
  return anchor == Anchor::end ? "end" : "start";
}

}  // namespace

std::string escape_xml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else {
      escaped += static_cast<unsigned char>(c) < 0x20U ? ' ' : c;
    }
  }
  return escaped;
}

Svg::Svg(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
  rectangle({0.0, 0.0}, width_px, height_px, "#ffffff");
}

void Svg::rectangle(SvgPoint top_left, double width_px, double height_px, const char* colour,
                    double opacity) {
  elements_ += "<rect" + attribute("x", top_left.x) + attribute("y", top_left.y) +
               attribute("width", width_px) + attribute("height", height_px) + attribute("fill", colour);
  if (opacity < 1.0) elements_ += attribute("fill-opacity", opacity);
  elements_ += "/>\n";
}

void Svg::circle(SvgPoint centre, double radius_px, const char* colour, double opacity) {
  elements_ += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) + attribute("r", radius_px) +
               attribute("fill", colour);
  if (opacity < 1.0) elements_ += attribute("fill-opacity", opacity);
  elements_ += "/>\n";
}

void Svg::line(SvgPoint from, SvgPoint to, const Stroke& stroke) {
  elements_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
               attribute("y2", to.y) + stroke_attributes(stroke) + "/>\n";
}

void Svg::polyline(const std::vector<SvgPoint>& points, const Stroke& stroke) {
  std::string list;
  for (const SvgPoint& point : points) {
    if (!list.empty()) list += ' ';
    list += fixed(point.x, kDecimals) + "," + fixed(point.y, kDecimals);
  }
  elements_ += "<polyline" + attribute("points", list) + attribute("fill", "none") +
               stroke_attributes(stroke) + attribute("stroke-linejoin", "round") + "/>\n";
}

void Svg::text(SvgPoint position, const std::string& text, const TextStyle& style) {
  const std::string place = fixed(position.x, kDecimals) + "," + fixed(position.y, kDecimals);
  elements_ += "<text" + attribute("x", position.x) + attribute("y", position.y) +
               attribute("font-size", style.size_px) + attribute("fill", style.colour) +
               attribute("text-anchor", name(style.anchor));
  if (style.is_bold) elements_ += attribute("font-weight", "bold");
  if (style.is_upright) elements_ += attribute("transform", "rotate(-90," + place + ")");
  const std::string escaped = escape_xml(text);
  elements_ += ">" + escaped + "</text>\n";
}

std::string Svg::str() const {
  const std::string width = std::to_string(width_px_);
  const std::string height = std::to_string(height_px_);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg" +
         attribute("xmlns", "http://www.w3.org/2000/svg") + attribute("width", width) +
         attribute("height", height) + attribute("viewBox", "0 0 " + width + " " + height) +
         attribute("font-family", "Helvetica, Arial, 'DejaVu Sans', sans-serif") + ">\n" + elements_ +
         "</svg>\n";
}

}  // namespace traygauge
