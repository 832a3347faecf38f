// Trays rendered with the cards that Traygauge makes, measured from the first pixel to the volumes.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "firmware/base/exit_status.hpp"
#include "firmware/card/card_drawing.hpp"
#include "firmware/measure/measure_command.hpp"
#include "firmware/segment/segment_command.hpp"
#include "simulator/capture/png_writer.hpp"
#include "simulator/capture/truth.hpp"
#include "simulator/scenes/capture_writer.hpp"
#include "simulator/scenes/scene_file.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

class PrintedCard : public testing::Test {
 protected:
  // The shipped example at 640 × 480, with the card of this number.
  fs::path render(int number) {
    SceneDescription scene = read_scene_file(fs::path(TRAYGAUGE_SOURCE_DIR) / "config/scenes/example.toml");
    CameraDescription& camera = scene.photography.camera;
    constexpr double kScale = 0.4;
    camera.size = {640, 480};
    camera.fx_px *= kScale;
    camera.fy_px *= kScale;
    camera.cx_px = 0.5 * (camera.size.width - 1);
    camera.cy_px = 0.5 * (camera.size.height - 1);
    scene.card.print = folder_.path() / (card_id(number) + ".png");
    write_png(scene.card.print, picture_of(draw_card(number), {2140, 1350}, 3).frame());
    RenderSettings settings;
    settings.samples = 8;
    const fs::path capture = folder_.path() / ("tray " + card_id(number));
    render_capture(scene, capture, settings, [](double) {});
    // What the station would have, instead of the finer picture that was rendered.
    write_png(capture / "card.png", card_picture(number).frame());
    return capture;
  }

  static nlohmann::json measure(const fs::path& capture, const std::string& labels) {
    MeasureOptions options;
    options.capture = capture.string();
    options.labels = labels;
    options.json = true;
    std::ostringstream out;
    std::ostringstream error;
    run_measure(options, out, error);
    return nlohmann::json::parse(out.str());
  }

  TemporaryFolder folder_;
};

TEST_F(PrintedCard, MeasuresTraysAndNamesAnotherCard) {
  for (const int number : {2, 11}) {
    const fs::path capture = render(number);
    const Truth truth = *read_truth(capture);
    for (const std::string labels : {"given", "auto"}) {
      const nlohmann::json document = measure(capture, labels);
      ASSERT_EQ(document["status"], "ok") << card_id(number) << " " << labels << ": " << document["message"];
      double volume_ml = 0.0;
      double truth_ml = 0.0;
      for (const auto& item : document["items"]) volume_ml += item["volume_ml"].get<double>();
      for (const TruthItem& item : truth.items) truth_ml += item.volume_ml;
      EXPECT_NEAR(volume_ml / truth_ml, 1.0, 0.05) << card_id(number) << " " << labels;
    }
    const int expected = number - 1;
    write_png(capture / "card.png", card_picture(expected).frame());
    for (const std::string labels : {"given", "auto"}) {
      const nlohmann::json document = measure(capture, labels);
      EXPECT_EQ(document["status"], "card_not_found") << labels;
      const auto message = document["message"].get<std::string>();
      EXPECT_NE(
          message.find("Card " + card_id(number) + " lies there, but " + card_id(expected) + " was expected"),
          std::string::npos)
          << message;
    }
    SegmentOptions options;
    options.capture = capture.string();
    std::ostringstream out;
    EXPECT_EQ(run_segment(options, out), kExitNotMeasurable);
    EXPECT_NE(out.str().find("Card " + card_id(number) + " lies there"), std::string::npos) << out.str();
  }
}

}  // namespace
}  // namespace traygauge
