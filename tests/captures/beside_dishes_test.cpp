// An item that somebody outlined beside the dishes is told of, whatever becomes of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "firmware/measure/capture_session.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/png_writer.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kBeside = 50;
constexpr int kSide = 60;  // px

// A square in the first corner of the picture in which nothing is labelled, 20 px from its edges.
void label_square(Picture& labels) {
  const auto at = [&](int x, int y) -> std::uint8_t& {
    return labels.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(labels.size.width) +
                         static_cast<std::size_t>(x)];
  };
  for (const int top : {20, labels.size.height - 20 - kSide}) {
    for (const int left : {20, labels.size.width - 20 - kSide}) {
      bool is_bare = true;
      for (int y = top; y < top + kSide; ++y) {
        for (int x = left; x < left + kSide; ++x) is_bare = is_bare && at(x, y) == kBackgroundLabel;
      }
      if (!is_bare) continue;
      for (int y = top; y < top + kSide; ++y) {
        for (int x = left; x < left + kSide; ++x) at(x, y) = kBeside;
      }
      return;
    }
  }
  FAIL() << "no corner of the picture is bare";
}

// The capture with such a square in the labels of its first pair, which lie in `folder`.
Capture with_square(Capture capture, const std::filesystem::path& folder) {
  for (const int v : capture.pairs.front()) {
    ViewDescription& view = capture.views[static_cast<std::size_t>(v)];
    Picture labels = read_picture(*view.labels);
    label_square(labels);
    view.labels->path = folder / ("labels_" + std::to_string(v) + ".png");
    write_png(view.labels->path, labels.frame());
  }
  return capture;
}

TEST(BesideDishes, AnItemIsNeverLeftOutInSilence) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  for (const char* name : {"meals/m01", "trays/t01"}) {
    const TemporaryFolder folder;
    const Capture capture = read_capture(captures_folder() / name);
    const Capture changed = with_square(capture, folder.path());
    CaptureSession still(capture, capture.pairs.front(), capture.dishes);
    CaptureSession session(changed, changed.pairs.front(), changed.dishes);
    const Measurement& before = still.measure(1);
    const Measurement& measurement = session.measure(1);
    ASSERT_EQ(measurement.items.size(), before.items.size() + 1) << name;
    const auto beside = std::ranges::find(measurement.items, kBeside, &ItemResult::label);
    ASSERT_NE(beside, measurement.items.end()) << name;
    EXPECT_TRUE(is_tray_place(beside->dish)) << name;
    EXPECT_EQ(measurement.warnings.holds(Warning::item_beside_dishes, kBeside),
              beside->status == StatusCode::ok)
        << name;
    for (std::size_t i = 0; i < before.items.size(); ++i)
      EXPECT_NEAR(measurement.items[i].volume_ml, before.items[i].volume_ml, 0.03 * before.items[i].volume_ml)
          << name;
  }
}

}  // namespace
}  // namespace traygauge
