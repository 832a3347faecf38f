#include "tests/support/faulty_capture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLastItem = 199;
constexpr int kCard = 255;

double to_light(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double to_code(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

cv::Mat3f decode(const cv::Mat3b& picture) {
  cv::Mat1f table(1, 256);
  for (int i = 0; i < 256; ++i) table(i) = static_cast<float>(to_light(i / 255.0));
  cv::Mat3f light;
  cv::LUT(picture, table, light);
  return light;
}

cv::Mat3b encode(const cv::Mat3f& light) {
  constexpr int kSteps = 65535;
  static const cv::Mat1b table = [] {
    cv::Mat1b values(1, kSteps + 1);
    for (int i = 0; i <= kSteps; ++i) {
      values(i) = cv::saturate_cast<std::uint8_t>(255.0 * to_code(static_cast<double>(i) / kSteps));
    }
    return values;
  }();
  cv::Mat3b picture(light.size());
  for (int y = 0; y < light.rows; ++y) {
    for (int x = 0; x < light.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        picture(y, x)[c] =
            table(static_cast<int>(std::lround(kSteps * std::clamp(light(y, x)[c], 0.F, 1.F))));
      }
    }
  }
  return picture;
}

cv::Mat grown(const cv::Mat& mask, int px) {
  cv::Mat result;
  cv::dilate(mask, result, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * px + 1, 2 * px + 1}));
  return result;
}

// The table beside the region.
cv::Scalar colour_beside(const FaultyView& view, const cv::Mat& region) {
  return cv::mean(view.picture, grown(region, 12) & (view.labels == 0));
}

cv::Mat shifted(const cv::Mat& picture, cv::Point offset, int border) {
  const cv::Matx23d motion(1, 0, offset.x, 0, 1, offset.y);
  cv::Mat result;
  cv::warpAffine(picture, result, motion, picture.size(), cv::INTER_NEAREST, border);
  return result;
}

}  // namespace

FaultyCapture::FaultyCapture(const fs::path& original, std::array<int, 2> pair)
    : document_(nlohmann::json::parse(read_text(original / "capture.json"))) {
  const std::string pattern = document_.at("card").at("pattern");
  fs::copy_file(original / pattern, folder_.path() / pattern);
  nlohmann::json kept = nlohmann::json::array();
  for (std::size_t i = 0; i < 2; ++i) {
    nlohmann::json entry = document_.at("views").at(static_cast<std::size_t>(pair[i]));
    views_[i].picture = cv::imread((original / entry.at("image").get<std::string>()).string());
    views_[i].labels =
        cv::imread((original / entry.at("labels").get<std::string>()).string(), cv::IMREAD_GRAYSCALE);
    if (views_[i].picture.empty() || views_[i].labels.empty()) {
      throw std::runtime_error("no pictures in " + original.string());
    }
    entry["image"] = "view_" + std::to_string(i) + ".jpg";
    entry["labels"] = "labels_" + std::to_string(i) + ".png";
    kept.push_back(std::move(entry));
  }
  document_["views"] = std::move(kept);
  document_["pairs"] = {{0, 1}};
}

fs::path FaultyCapture::store() const {
  for (std::size_t i = 0; i < 2; ++i) {
    const nlohmann::json& entry = document_.at("views").at(i);
    const auto file = [&](const char* key) {
      return (folder_.path() / entry.at(key).get<std::string>()).string();
    };
    if (!cv::imwrite(file("image"), views_[i].picture, {cv::IMWRITE_JPEG_QUALITY, 95}) ||
        !cv::imwrite(file("labels"), views_[i].labels)) {
      throw std::runtime_error("cannot write " + folder_.path().string());
    }
  }
  write_text(folder_.path() / "capture.json", document_.dump(1));
  return folder_.path();
}

void defocus(FaultyView& view, double sigma_px) {
  cv::Mat3f light = decode(view.picture);
  cv::GaussianBlur(light, light, {0, 0}, sigma_px);
  view.picture = encode(light);
}

void shake(FaultyView& view, double length_px, double direction_deg) {
  const int radius = static_cast<int>(std::ceil(length_px / 2)) + 1;
  cv::Mat1f kernel(2 * radius + 1, 2 * radius + 1, 0.0F);
  const double angle = direction_deg * std::numbers::pi / 180.0;
  const int steps = 16 * radius;
  for (int i = 0; i < steps; ++i) {
    const double t = length_px * ((i + 0.5) / steps - 0.5);
    const double x = radius + t * std::cos(angle);
    const double y = radius + t * std::sin(angle);
    const int left = static_cast<int>(x);
    const int top = static_cast<int>(y);
    for (int corner = 0; corner < 4; ++corner) {
      const int column = left + corner % 2;
      const int row = top + corner / 2;
      kernel(row, column) += static_cast<float>((1.0 - std::abs(x - column)) * (1.0 - std::abs(y - row)));
    }
  }
  kernel /= cv::sum(kernel)[0];
  cv::Mat3f light = decode(view.picture);
  cv::filter2D(light, light, -1, kernel);
  view.picture = encode(light);
}

void expose(FaultyView& view, double gain) {
  view.picture = encode(cv::Mat3f(decode(view.picture) * gain));
}

void tint(FaultyView& view, double ratio) {
  cv::Mat3f light = decode(view.picture);
  cv::multiply(light, cv::Scalar(1.0 / ratio, 1.0, ratio), light);
  view.picture = encode(light);
}

void add_noise(FaultyView& view, double sigma, unsigned seed) {
  cv::Mat3s noise(view.picture.size());
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  cv::add(view.picture, noise, view.picture, cv::noArray(), CV_8U);
}

void paint_items_flat(FaultyView& view) {
  for (int label = 2; label <= kLastItem; ++label) {
    const cv::Mat item = view.labels == label;
    if (cv::countNonZero(item) > 0) view.picture.setTo(cv::mean(view.picture, item), item);
  }
}

namespace {

// Around the card's label, the longer side first, and the direction of that side.
cv::RotatedRect card_box(const cv::Mat& card, cv::Point2d& along) {
  std::vector<cv::Point> pixels;
  cv::findNonZero(card, pixels);
  cv::RotatedRect box = cv::minAreaRect(pixels);
  if (box.size.width < box.size.height) {
    std::swap(box.size.width, box.size.height);
    box.angle += 90.0F;
  }
  const double angle = box.angle * std::numbers::pi / 180.0;
  along = {std::cos(angle), std::sin(angle)};
  return box;
}

}  // namespace

void cover_card(FaultyView& view, double share) {
  const cv::Mat card = view.labels == kCard;
  cv::Point2d along;
  const cv::RotatedRect box = card_box(card, along);
  const cv::Scalar table = colour_beside(view, card);
  std::vector<cv::Point> pixels;
  cv::findNonZero(card, pixels);
  for (const cv::Point& pixel : pixels) {
    const cv::Point2d offset = cv::Point2d(pixel) - cv::Point2d(box.center);
    if (offset.dot(along) < (0.5 - share) * box.size.width) continue;
    view.labels(pixel) = 0;
  }
  view.picture.setTo(table, grown(card & (view.labels == 0), 2) & (view.labels == 0));
}

void bend_card(FaultyView& view, double rise_px) {
  const cv::Mat card = view.labels == kCard;
  cv::Point2d along;
  const cv::RotatedRect box = card_box(card, along);
  const cv::Mat3b picture = view.picture.clone();
  const cv::Scalar table = colour_beside(view, card);
  view.picture.setTo(table, grown(card, 2));
  view.labels.setTo(0, card);
  cv::Mat1f from_x(picture.size());
  cv::Mat1f from_y(picture.size());
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const double u = (cv::Point2d(x, y) - cv::Point2d(box.center)).dot(along) / (0.5 * box.size.width);
      from_x(y, x) = static_cast<float>(x);
      from_y(y, x) = static_cast<float>(y + rise_px * std::min(u * u, 1.5));
    }
  }
  cv::Mat3b bent;
  cv::Mat1b bent_card;
  cv::remap(picture, bent, from_x, from_y, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  cv::remap(card, bent_card, from_x, from_y, cv::INTER_NEAREST, cv::BORDER_CONSTANT);
  bent.copyTo(view.picture, bent_card);
  view.labels.setTo(kCard, bent_card);
}

void shift_dish_out(FaultyView& view, int px) {
  const cv::Rect box = cv::boundingRect((view.labels > 0) & (view.labels <= kLastItem));
  const cv::Point offset(-box.x - px, 0);
  view.picture = shifted(view.picture, offset, cv::BORDER_REFLECT);
  view.labels = shifted(view.labels, offset, cv::BORDER_CONSTANT);
}

void move_item(FaultyView& view, int label, cv::Point offset_px) {
  const cv::Mat item = view.labels == label;
  const cv::Mat3b picture = view.picture.clone();
  const cv::Scalar dish = cv::mean(picture, grown(item, 8) & (view.labels == 1));
  view.picture.setTo(dish, item);
  view.labels.setTo(1, item);
  const cv::Mat moved_item = shifted(item, offset_px, cv::BORDER_CONSTANT);
  shifted(picture, offset_px, cv::BORDER_REFLECT).copyTo(view.picture, moved_item);
  view.labels.setTo(label, moved_item);
}

void keep_table_still(const FaultyView& first, FaultyView& second) {
  constexpr int kShadow_px = 6;
  const cv::Mat tray = grown(second.labels != 0, kShadow_px);
  const cv::Mat uncovered = grown(first.labels != 0, kShadow_px);
  cv::Mat3b table = first.picture.clone();
  // What the tray stood on in the first picture: the same table from elsewhere.
  cv::Mat missing = uncovered.clone();
  for (const int offset_px : {table.cols / 2, -table.cols / 2, 3 * table.cols / 4, -3 * table.cols / 4}) {
    const cv::Mat is_table = shifted(255 - uncovered, {offset_px, 0}, cv::BORDER_CONSTANT) & missing;
    shifted(first.picture, {offset_px, 0}, cv::BORDER_CONSTANT).copyTo(table, is_table);
    missing.setTo(0, is_table);
  }
  table.setTo(colour_beside(first, uncovered), missing);
  second.picture.copyTo(table, tray);
  second.picture = table;
}

}  // namespace traygauge::test
