// How well a station tells dirt on its lens over many trays (firmware/station/lens_watch.hpp). Usage:
//   lens_spots STATION... > spots.csv
// Each STATION is a folder of captures that one still or moving camera took, of station-40 say, all with
// labels; they come in the order of their names. Dirt is drawn into copies of their pictures: at places that
// show a dish or food, drawn from a printed seed, so wide and letting so much light through. A line of CSV
// for each width and light: at how many of the places it was told after 20 trays, to within its own width.
// The light of 1 is the clean station: after how many of its trays something was told.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "firmware/station/lens_watch.hpp"
#include "simulator/capture/capture.hpp"
#include "simulator/capture/input_error.hpp"

namespace {

using namespace traygauge;

constexpr std::uint32_t kSeed = 1;
constexpr int kPlaces = 24;                                   // of each width and light
constexpr std::array kWidths = {0.025, 0.0375, 0.0625, 0.1};  // of the picture's longer side
constexpr std::array kLights = {0.05, 0.15, 0.3, 0.5};        // of what comes, in the spot's middle
constexpr double kSoft = 0.3;  // of the spot's radius, over which its edge fades to either side

using Tray = std::array<LoadedView, 2>;

std::vector<Tray> load_station(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> captures;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (std::filesystem::exists(entry.path() / "capture.json")) captures.push_back(entry.path());
  }
  std::sort(captures.begin(), captures.end());
  std::vector<Tray> trays;
  for (const std::filesystem::path& path : captures) {
    const Capture capture = read_capture(path);
    trays.push_back({load_view(capture.views.at(0)), load_view(capture.views.at(1))});
  }
  return trays;
}

struct Spot {
  double x_px = 0.0;
  double y_px = 0.0;
  double width_px = 0.0;
  double light = 1.0;
};

// Grey values as sRGB has them; a power of 2.2 is near enough.
void darken(Picture& picture, const Spot& spot) {
  const FrameView frame = picture.frame();
  const double radius = 0.5 * spot.width_px;
  const double reach = (1.0 + kSoft) * radius;
  for (int y = std::max(0, static_cast<int>(spot.y_px - reach)); y < frame.height && y <= spot.y_px + reach;
       ++y) {
    for (int x = std::max(0, static_cast<int>(spot.x_px - reach)); x < frame.width && x <= spot.x_px + reach;
         ++x) {
      const double inside =
          std::clamp((reach - std::hypot(x - spot.x_px, y - spot.y_px)) / (2.0 * kSoft * radius), 0.0, 1.0);
      const double light = 1.0 - (1.0 - spot.light) * inside * inside * (3.0 - 2.0 * inside);
      const int channels = bytes_per_pixel(frame.format);
      for (int c = 0; c < channels; ++c) {
        std::uint8_t& value = picture.pixels[static_cast<std::size_t>(
            y * frame.stride_bytes + static_cast<std::ptrdiff_t>(x) * channels + c)];
        value = static_cast<std::uint8_t>(std::lround(value * std::pow(light, 1.0 / 2.2)));
      }
    }
  }
}

void show(LensWatch& watch, const Tray& tray) {
  watch.add(
      {{{tray[0].picture.frame(), tray[0].labels.gray()}, {tray[1].picture.frame(), tray[1].labels.gray()}}});
}

bool is_told(const std::vector<Tray>& trays, const Spot& spot) {
  LensWatch watch;
  const auto count = std::min(trays.size(), static_cast<std::size_t>(LensWatchParams().trays));
  for (std::size_t i = 0; i < count; ++i) {
    Tray spoilt = trays[i];
    for (LoadedView& view : spoilt) darken(view.picture, spot);
    show(watch, spoilt);
  }
  return watch.spot() &&
         std::hypot(watch.spot()->x_px - spot.x_px, watch.spot()->y_px - spot.y_px) <= spot.width_px;
}

// A place of the first tray's first picture that shows a dish or food.
Spot draw_place(const Tray& tray, std::mt19937& random) {
  const ImageView<const std::uint8_t> labels = tray[0].labels.gray();
  while (true) {
    const auto x = static_cast<int>(random() % static_cast<std::uint32_t>(labels.width));
    const auto y = static_cast<int>(random() % static_cast<std::uint32_t>(labels.height));
    if (is_dish(labels.at(x, y)) || is_item(labels.at(x, y)))
      return {static_cast<double>(x), static_cast<double>(y)};
  }
}

void print_clean(const char* name, const std::vector<Tray>& trays) {
  LensWatch watch;
  int told = 0;
  for (const Tray& tray : trays) {
    show(watch, tray);
    if (watch.spot()) ++told;
  }
  std::printf("%s,,1,%d,%zu\n", name, told, trays.size());
}

void print_spots(const char* name, const std::vector<Tray>& trays) {
  const FrameView frame = trays[0][0].picture.frame();
  for (const double width : kWidths) {
    for (const double light : kLights) {
      std::mt19937 random(kSeed);
      int told = 0;
      for (int i = 0; i < kPlaces; ++i) {
        Spot spot = draw_place(trays[0], random);
        spot.width_px = width * std::max(frame.width, frame.height);
        spot.light = light;
        if (is_told(trays, spot)) ++told;
      }
      std::printf("%s,%g,%g,%d,%d\n", name, width, light, told, kPlaces);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::fprintf(stderr, "seed %u\n", kSeed);
    std::puts("station,width,light,told,of");
    for (int i = 1; i < argc; ++i) {
      const std::vector<Tray> trays = load_station(argv[i]);
      if (trays.empty()) {
        std::fprintf(stderr, "lens_spots: %s: expected captures in it, found none\n", argv[i]);
        return 2;
      }
      print_clean(argv[i], trays);
      print_spots(argv[i], trays);
    }
  } catch (const InputError& error) {
    std::fprintf(stderr, "lens_spots: %s\n", error.what());
    return 2;
  }
  return 0;
}
