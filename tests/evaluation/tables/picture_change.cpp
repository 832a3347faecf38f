#include "tests/evaluation/tables/picture_change.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "simulator/capture/content_hash.hpp"
#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge::tables {
namespace {

// Chosen for the look of a phone's pictures: shadows a stop lighter, halos around bright rims.
constexpr double kToneClip = 3.0;
constexpr int kToneTiles = 8;

void even_out_tone(cv::Mat& pixels, PixelFormat format) {
  const auto tone = cv::createCLAHE(kToneClip, {kToneTiles, kToneTiles});
  if (format == PixelFormat::gray8) {
    tone->apply(pixels, pixels);
    return;
  }
  const bool is_rgb = format == PixelFormat::rgb8;
  cv::Mat lab;
  cv::cvtColor(pixels, lab, is_rgb ? cv::COLOR_RGB2Lab : cv::COLOR_BGR2Lab);
  cv::Mat lightness;
  cv::extractChannel(lab, lightness, 0);
  tone->apply(lightness, lightness);
  cv::insertChannel(lightness, lab, 0);
  cv::cvtColor(lab, pixels, is_rgb ? cv::COLOR_Lab2RGB : cv::COLOR_Lab2BGR);
}

void add_noise(cv::Mat& pixels, double deviation_grey, std::uint64_t seed) {
  cv::Mat noise(pixels.size(), CV_32FC1);
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0.0, deviation_grey);
  const std::vector<cv::Mat> alike(static_cast<std::size_t>(pixels.channels()), noise);
  cv::Mat all;
  cv::merge(alike, all);
  cv::add(pixels, all, pixels, cv::noArray(), pixels.type());
}

}  // namespace

std::string describe(const PictureChange& change) {
  std::ostringstream text;
  text.precision(17);
  text << "noise " << change.noise_grey << " grey values, local tone "
       << (change.local_tone ? "evened out" : "as it is");
  return text.str();
}

void change_picture(const PictureChange& change, std::uint64_t seed, Picture& picture) {
  cv::Mat pixels(picture.size.height, picture.size.width,
                 picture.format == PixelFormat::gray8 ? CV_8UC1 : CV_8UC3, picture.pixels.data());
  if (change.local_tone) even_out_tone(pixels, picture.format);
  if (change.noise_grey > 0.0) add_noise(pixels, change.noise_grey, seed);
}

Capture change_views(Capture capture, const std::array<int, 2>& pair, const PictureChange& change,
                     const std::filesystem::path& folder) {
  for (const int index : pair) {
    ViewDescription& view = capture.views.at(static_cast<std::size_t>(index));
    const auto bytes = read_bytes(view.image, kMaxPictureFileBytes, "a readable picture");
    Picture picture = read_picture(view.image, view.camera.size);
    change_picture(change, std::stoull(content_hash(bytes), nullptr, 16), picture);
    view.image.path = folder / ("view_" + std::to_string(index) + ".png");
    write_png(view.image.path, picture.frame());
  }
  return capture;
}

}  // namespace traygauge::tables
