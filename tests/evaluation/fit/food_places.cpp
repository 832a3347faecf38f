// What places of dishes show, and whether food lies there: what fit_food_evidence.py fits to. Usage:
//   food_places CAPTURE... > places.csv
// Each capture has labels. Food is found in its first pair as if it had none; each place at which that looks,
// where the labels show a dish or an item, is a line of CSV on standard output: capture, whether it is food,
// and the signs (core/segmentation/food_evidence.hpp).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/capture_session.hpp"
#include "firmware/measure/measure_choices.hpp"
#include "simulator/capture/capture.hpp"
#include "simulator/capture/input_error.hpp"

namespace {

using namespace traygauge;

class Places final : public FoodObserver {
 public:
  void on_view(std::size_t view) override { view_ = view; }
  void on_place(const Vec2& pixel, int, const FoodSigns& signs, double) override {
    places_.push_back({view_, pixel, signs});
  }
  void print(const std::string& name, const CaptureSession& session) const {
    for (const Place& place : places_) {
      const ImageView<const std::uint8_t> labels = session.given_labels()[place.view].gray();
      const std::uint8_t label =
          labels.at(std::clamp(static_cast<int>(std::lround(place.pixel.x())), 0, labels.width - 1),
                    std::clamp(static_cast<int>(std::lround(place.pixel.y())), 0, labels.height - 1));
      if (!is_item(label) && !is_dish(label)) continue;
      const FoodSigns& signs = place.signs;
      std::printf("%s,%d,%.3f,%.3f,%.3f,%.3f\n", name.c_str(), is_item(label) ? 1 : 0, signs.lift,
                  signs.against, signs.colour, signs.margin);
    }
  }

 private:
  struct Place {
    std::size_t view;
    Vec2 pixel;
    FoodSigns signs;
  };

  std::size_t view_ = 0;
  std::vector<Place> places_;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    std::puts("capture,is_food,lift,against,colour,margin");
    for (int i = 1; i < argc; ++i) {
      const Capture capture = read_capture(argv[i]);
      Places places;
      ProfileParameters parameters;
      parameters.best.food_observer = &places;
      const CaptureSession session(capture, choose_pair({}, capture), choose_dishes(capture, {}), parameters,
                                   LabelSource::automatic);
      places.print(argv[i], session);
    }
  } catch (const InputError& error) {
    std::fprintf(stderr, "food_places: %s\n", error.what());
    return 2;
  }
  return 0;
}
