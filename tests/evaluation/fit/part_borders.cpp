// Where parts of food meet, and whether both are of one item: what fit_part_likeness.py fits to. Usage:
//   part_borders CAPTURE...
// Each capture has labels. Food is cut into parts as core/segmentation/item_split.hpp has it, on the true
// food of every view; parts are then joined as they should be, and each border that there is on the way is a
// line of CSV on standard output: capture, whether both parts are of one item, blocks of the smaller part,
// and the two signs.
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "core/segmentation/item_split.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/network/food_network.hpp"
#include "simulator/capture/capture.hpp"
#include "simulator/capture/input_error.hpp"
#include "tests/bench/workspace.hpp"

namespace {

using namespace traygauge;

constexpr std::uint8_t kFood = 1;

class Borders {
 public:
  Borders() : block_(required_bytes(food_network())), runner_(food_network(), block_.bytes()) {}

  void print(const std::string& name, const LoadedView& view) {
    const PictureReading reading = read_picture(view.picture.frame(), food_network(), runner_, *storage_);
    const ImageView<const std::uint8_t> labels = view.labels.gray();
    const LabelRegions regions = measure_regions(labels);
    const PixelBox dish = regions.boxes[kDishLabel];
    if (dish.empty()) return;
    const std::array<Vec2, 4> box = {Vec2(dish.left, dish.top), Vec2(dish.right, dish.top),
                                     Vec2(dish.right, dish.bottom), Vec2(dish.left, dish.bottom)};
    // Dishes are about as large as they are seen: cells of a millimetre for one of 260 mm.
    const double px_per_mm = dish.width() / 260.0;
    DishRaster raster;
    if (!load_dish_raster(view.picture.frame(), box, px_per_mm, {}, *raster_, raster)) return;
    std::vector<std::uint8_t> cells(static_cast<std::size_t>(raster.width()) *
                                    static_cast<std::size_t>(raster.height()));
    const ImageView<std::uint8_t> owners{cells.data(), raster.width(), raster.height()};
    for (int y = 0; y < owners.height; ++y) {
      for (int x = 0; x < owners.width; ++x)
        owners.at(x, y) = is_item(label_at(labels, raster, x, y)) ? kFood : 0;
    }
    const ItemSplitParams params;
    const PartedFood food = part_food(raster, reading, kFood, params, *split_, owners);
    join(name, labels, raster, food);
  }

 private:
  static std::uint8_t label_at(ImageView<const std::uint8_t> labels, const DishRaster& raster, double x,
                               double y) {
    const Vec2 pixel = raster.pixel_of(x, y);
    return labels.at(std::clamp(static_cast<int>(pixel.x()), 0, labels.width - 1),
                     std::clamp(static_cast<int>(pixel.y()), 0, labels.height - 1));
  }

  void join(const std::string& name, ImageView<const std::uint8_t> labels, const DishRaster& raster,
            const PartedFood& food) {
    const auto true_item = [&](int part) {
      std::array<int, kByteValues> counts{};
      food.parts.for_each_block([&](int block) {
        if (!food.parts.is_food(block) || food.parts.root(block) != part) return;
        const double middle = 0.5 * (food.side - 1);
        ++counts[label_at(labels, raster, block % food.parts.columns() * food.side + middle,
                          block / food.parts.columns() * food.side + middle)];
      });
      return std::max_element(counts.begin(), counts.end()) - counts.begin();
    };
    for (bool is_joined = true; is_joined;) {
      is_joined = false;
      for (const PartBorder& border : measure_borders(food.parts, (*split_).joining)) {
        const bool is_one = true_item(border.first) == true_item(border.second);
        const PartSigns signs = signs_of(food.parts, border);
        std::printf("%s,%d,%d,%.4f,%.4f\n", name.c_str(), is_one ? 1 : 0,
                    std::min(food.parts.at(border.first).size, food.parts.at(border.second).size),
                    signs.embedding, signs.share);
        if (!is_one) continue;
        food.parts.join(border.first, border.second);
        is_joined = true;
        break;
      }
    }
  }

  AlignedBlock block_;
  NetworkRunner runner_;
  bench::OwnedWorkspace<PictureReadingStorage> storage_{food_network()};
  bench::OwnedWorkspace<DishRasterWorkspace> raster_{DishRasterParams{}};
  bench::OwnedWorkspace<ItemSplitWorkspace> split_{ItemSplitParams{}};
};

}  // namespace

int main(int argc, char** argv) {
  try {
    Borders borders;
    std::puts("capture,is_one,blocks,embedding,share");
    for (int i = 1; i < argc; ++i) {
      const Capture capture = read_capture(argv[i]);
      for (const ViewDescription& view : capture.views) borders.print(argv[i], load_view(view));
    }
  } catch (const InputError& error) {
    std::fprintf(stderr, "part_borders: %s\n", error.what());
    return 2;
  }
  return 0;
}
