// Dishes and food found on photographs of real trays, against outlines that people drew. The photographs have
// no card and no second view: a camera that looks straight down stands in for both, and a dish may be of any
// size. What is scored is the search for rims and the telling of food from glaze. Usage:
//   real_food_on_trays FOLDER [SHEET.png]
// FOLDER holds NAME.jpg, and NAME_mask.png whose pixels are 0 where there is no food.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/pipeline/segmenter_memory.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/network/food_network.hpp"

namespace {

using namespace traygauge;
namespace fs = std::filesystem;

constexpr double kPxPerMm = 2.5;  // of the camera that stands in; dishes come in any size
constexpr double kCameraHeightMm = 600.0;
constexpr double kSmallestMm = 120.0;
constexpr double kLargestMm = 320.0;
constexpr double kSizeStep = 1.05;
constexpr std::size_t kMaxDishes = 4;
constexpr double kFlangeShare = 0.2;  // of the radius: most plates have so wide a rim
constexpr std::size_t kCorners = 180;

struct Tray {
  std::string name;
  cv::Mat3b picture;
  cv::Mat1b food;   // 255 where people saw it
  cv::Mat1b found;  // 255 where it was found
  std::vector<FoundDish> dishes;
  double iou = 0.0;
  double iou_on_dishes = 0.0;  // where a dish was found
};

class Finder {
 public:
  Finder() : block_(planned_bytes()) {
    Arena arena(block_.bytes());
    memory_.allocate(arena, configuration_);
    edge_search_block_ = std::make_unique<AlignedBlock>(edge_bytes());
    Arena edge_arena(edge_search_block_->bytes());
    edges_.allocate(edge_arena, params().dish.edges);
    for (double size_mm = kSmallestMm; size_mm <= kLargestMm; size_mm *= kSizeStep) {
      DishModel dish;
      dish.outer_size_mm = {size_mm, size_mm};
      sizes_.push_back(dish);
    }
  }

  void find(Tray& tray) {
    const FrameView frame{tray.picture.data, tray.picture.cols, tray.picture.rows,
                          static_cast<std::ptrdiff_t>(tray.picture.step), PixelFormat::bgr8};
    cv::Mat1b gray;
    cv::cvtColor(tray.picture, gray, cv::COLOR_BGR2GRAY);
    DishSearchView view;
    view.frame = {gray.data, gray.cols, gray.rows, static_cast<std::ptrdiff_t>(gray.step),
                  PixelFormat::gray8};
    const double focal_px = kPxPerMm * kCameraHeightMm;
    view.lens = {gray.cols, gray.rows, {focal_px, focal_px, 0.5 * gray.cols, 0.5 * gray.rows}};
    view.camera_from_table.rotation = Vec3(1.0, -1.0, -1.0).asDiagonal();
    view.camera_from_table.translation = {0.0, 0.0, kCameraHeightMm};
    for (BoundedList<RimEdge>& list : memory_.edges) {
      collect_rim_edges({gray.data, gray.cols, gray.rows}, view.lens, params().dish.edges, edges_, list);
    }
    tray.found = cv::Mat1b(gray.size(), 0);
    while (tray.dishes.size() < kMaxDishes) {
      const Result<FoundDish> dish =
          search_dish({view, view}, memory_.edges, sizes_, tray.dishes, params().dish, memory_.dish);
      if (!dish.ok()) break;
      tray.dishes.push_back(*dish);
    }
    Arena arena(block_.bytes());
    memory_.allocate(arena, configuration_);
    NetworkRunner runner(food_network(), memory_.food.network);
    const PictureReading reading = read_picture(frame, food_network(), runner, memory_.food.readings[0]);
    for (const FoundDish& found : tray.dishes) mark_food(frame, reading, view, found, tray.found);
  }

  static std::vector<Vec2> outline(const DishSearchView& view, const DishPose& place, double share) {
    std::vector<Vec2> corners(kCorners);
    for (std::size_t i = 0; i < kCorners; ++i) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kCorners;
      const Vec3 rim = rim_normal(place, {std::cos(angle), std::sin(angle)})
                           .beyond((share - 1.0) * 0.5 * place.size_mm[0]);
      corners[i] = view.lens.pixel((view.camera_from_table * rim).hnormalized());
    }
    return corners;
  }

 private:
  const SegmenterParams& params() const { return configuration_.segmentation; }
  std::size_t planned_bytes() const {
    ArenaPlan plan;
    SegmenterMemory().allocate(plan, configuration_);
    return plan.high_water_bytes();
  }
  std::size_t edge_bytes() const {
    ArenaPlan plan;
    RimEdgeWorkspace().allocate(plan, params().dish.edges);
    return plan.high_water_bytes();
  }

  // The plan of memory needs a network.
  static Configuration configure() {
    Configuration configuration;
    configuration.network = &food_network();
    return configuration;
  }

  void mark_food(const FrameView& frame, const PictureReading& reading, const DishSearchView& view,
                 const FoundDish& dish, cv::Mat1b& food) {
    FoodOutlineWorkspace& workspace = memory_.food.outline;
    DishRaster raster;
    std::vector<Vec2> corners = outline(view, dish.place, 1.0);
    if (!load_dish_raster(frame, corners, kPxPerMm, params().food.raster, workspace.raster, raster)) return;
    mark_zone(raster, corners, DishZone::edge);
    const double edge_fraction = 2.0 * params().flange_begin_mm / dish.place.size_mm[0];
    corners = outline(view, dish.place, 1.0 - edge_fraction);
    mark_zone(raster, corners, DishZone::flange);
    corners = outline(view, dish.place, 1.0 - kFlangeShare);
    mark_zone(raster, corners, DishZone::inside);
    const ImageView<std::uint8_t> cells{memory_.food.cells.data(), raster.width(), raster.height()};
    // One picture alone tells no height.
    const ImageView<HeightSample> relief{workspace.relief.data(), raster.width(), raster.height()};
    std::fill_n(relief.data, raster.width() * raster.height(), HeightSample{});
    if (!outline_food({raster, relief, reading}, params().food, workspace, cells).is_outlined) return;
    for (int y = 0; y < raster.height(); ++y) {
      for (int x = 0; x < raster.width(); ++x) {
        if (cells.at(x, y) != kFoodSeed) continue;
        const cv::Rect cell(raster.left_px + x * raster.step_px, raster.top_px + y * raster.step_px,
                            raster.step_px, raster.step_px);
        food(cell & cv::Rect(0, 0, food.cols, food.rows)).setTo(255);
      }
    }
  }

  Configuration configuration_ = configure();
  AlignedBlock block_;
  SegmenterMemory memory_;
  std::unique_ptr<AlignedBlock> edge_search_block_;
  RimEdgeWorkspace edges_;
  std::vector<DishModel> sizes_;
};

double overlap(const cv::Mat1b& a, const cv::Mat1b& b) {
  const int either = cv::countNonZero(a | b);
  return either == 0 ? 1.0 : static_cast<double>(cv::countNonZero(a & b)) / either;
}

cv::Mat1b mask_of_dishes(const Tray& tray) {
  cv::Mat1b mask(tray.food.size(), 0);
  for (const FoundDish& dish : tray.dishes) {
    const Vec2 centre(0.5 * mask.cols + kPxPerMm * dish.place.centre_mm.x(),
                      0.5 * mask.rows - kPxPerMm * dish.place.centre_mm.y());
    cv::circle(mask, {cvRound(centre.x()), cvRound(centre.y())},
               cvRound(0.5 * kPxPerMm * dish.place.size_mm[0]), 255, cv::FILLED);
  }
  return mask;
}

cv::Mat3b draw(const Tray& tray) {
  cv::Mat3b drawn = tray.picture.clone();
  std::vector<std::vector<cv::Point>> contours;
  const auto add = [&](const cv::Mat1b& mask, const cv::Scalar& colour) {
    cv::findContours(mask.clone(), contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::drawContours(drawn, contours, -1, colour, 4);
  };
  add(mask_of_dishes(tray), {255, 120, 0});
  add(tray.food, {0, 220, 0});
  add(tray.found, {0, 0, 255});
  char title[96];
  std::snprintf(title, sizeof title, "%s  %.2f", tray.name.c_str(), tray.iou);
  cv::putText(drawn, title, {20, 60}, cv::FONT_HERSHEY_SIMPLEX, 1.6, {0, 0, 0}, 8);
  cv::putText(drawn, title, {20, 60}, cv::FONT_HERSHEY_SIMPLEX, 1.6, {255, 255, 255}, 3);
  cv::Mat3b small;
  cv::resize(drawn, small, {480, 360}, 0, 0, cv::INTER_AREA);
  return small;
}

void write_sheet(const std::string& file, const std::vector<Tray>& trays) {
  constexpr std::size_t kColumns = 4;
  std::vector<cv::Mat> rows;
  for (std::size_t i = 0; i < trays.size(); i += kColumns) {
    std::vector<cv::Mat> row;
    for (std::size_t k = 0; k < kColumns; ++k)
      row.push_back(i + k < trays.size() ? draw(trays[i + k])
                                         : cv::Mat(row[0].size(), row[0].type(), cv::Scalar::all(255)));
    rows.emplace_back();
    cv::hconcat(row, rows.back());
  }
  cv::Mat sheet;
  cv::vconcat(rows, sheet);
  cv::imwrite(file, sheet);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: real_food_on_trays FOLDER [SHEET.png]\n");
    return 2;
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(argv[1])) {
    if (entry.path().extension() == ".jpg") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  const auto finder = std::make_unique<Finder>();
  std::vector<Tray> trays;
  std::printf("%-28s %7s %9s %20s\n", "photograph", "dishes", "food IoU", "on the dishes found");
  double sum = 0.0;
  double sum_on_dishes = 0.0;
  for (const fs::path& file : files) {
    Tray tray;
    tray.name = file.stem().string();
    tray.picture = cv::imread(file.string());
    const cv::Mat mask =
        cv::imread((file.parent_path() / (tray.name + "_mask.png")).string(), cv::IMREAD_GRAYSCALE);
    if (tray.picture.empty() || mask.empty() || mask.size() != tray.picture.size()) continue;
    tray.food = mask > 0;
    finder->find(tray);
    tray.iou = overlap(tray.found, tray.food);
    cv::Mat1b on_dishes;
    cv::bitwise_and(tray.food, mask_of_dishes(tray), on_dishes);
    tray.iou_on_dishes = overlap(tray.found, on_dishes);
    sum += tray.iou;
    sum_on_dishes += tray.iou_on_dishes;
    std::printf("%-28s %7zu %9.3f %20.3f\n", tray.name.c_str(), tray.dishes.size(), tray.iou,
                tray.iou_on_dishes);
    trays.push_back(std::move(tray));
  }
  if (trays.empty()) {
    std::fprintf(stderr, "%s: no NAME.jpg with a NAME_mask.png of its size\n", argv[1]);
    return 2;
  }
  const auto count = static_cast<double>(trays.size());
  std::printf("%-28s %7s %9.3f %20.3f\n", "mean", "", sum / count, sum_on_dishes / count);
  if (argc > 2) write_sheet(argv[2], trays);
  return 0;
}
