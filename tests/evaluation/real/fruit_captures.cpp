#include "tests/evaluation/real/fruit_captures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "tests/support/capture_truth.hpp"
#include "tests/support/marker_card.hpp"

namespace traygauge {
namespace {

using test::TrueView;

constexpr double kLeastAngleDeg = 10.0;
constexpr double kMostAngleDeg = 28.0;
constexpr double kDishRadiusMm = 62.0;  // about the fruit, and beside the card
constexpr double kCardMarginMm = 1.0;
constexpr int kPictureMarginPx = 12;
constexpr int kFruitMarginPx = 4;
constexpr std::uint8_t kFruit = 2;

struct Markers {
  int row = 0;
  int column = 0;
};

// The page as the photographs' poses have it, in units that they call mm.
class Page {
 public:
  explicit Page(const nlohmann::json& corners) {
    for (const nlohmann::json& corner : corners) {
      const auto marker = corner[0].get<std::size_t>();
      corners_mm_.resize(std::max(corners_mm_.size(), marker + 1));
      corners_mm_[marker][corner[1].get<std::size_t>()] = Vec3(corner[2], corner[3], corner[4]);
    }
    const auto along_mm = [&](std::size_t from, std::size_t to) {
      return (corners_mm_[to][0] - corners_mm_[from][0]).norm();
    };
    constexpr std::size_t kLast = test::kMarkersAcrossPage - 1;
    constexpr std::size_t kLower = std::size_t{test::kMarkersAcrossPage} * (test::kMarkersDownPage - 1);
    scale_ = 0.5 * (along_mm(0, kLast) / kLast + along_mm(0, kLower) / (test::kMarkersDownPage - 1)) /
             test::kMarkerPitchMm;
  }
  double card_mm() const { return scale_ * test::kCardSideMarkers * test::kMarkerPitchMm; }
  std::vector<Vec3> outline_of(const Markers& markers) const {
    const double half_gap_mm = 0.5 * scale_ * (test::kMarkerPitchMm - test::kMarkerSideMm);
    const Vec3 corner_mm(scale_ * test::kMarkerPitchMm * markers.column - half_gap_mm,
                         half_gap_mm - scale_ * test::kMarkerPitchMm * markers.row, 0.0);
    return {corner_mm, corner_mm + Vec3(card_mm(), 0.0, 0.0), corner_mm + Vec3(card_mm(), -card_mm(), 0.0),
            corner_mm + Vec3(0.0, -card_mm(), 0.0)};
  }
  // Farthest that a corner of these markers lies from their plane.
  double bend_mm(const Markers& markers) const {
    std::vector<Vec3> points;
    for (int y = 0; y < test::kCardSideMarkers; ++y) {
      for (int x = 0; x < test::kCardSideMarkers; ++x) {
        const auto marker =
            static_cast<std::size_t>(test::kMarkersAcrossPage * (markers.row + y) + markers.column + x);
        points.insert(points.end(), corners_mm_[marker].begin(), corners_mm_[marker].end());
      }
    }
    cv::Mat1d terms(static_cast<int>(points.size()), 3);
    cv::Mat1d heights(static_cast<int>(points.size()), 1);
    for (int i = 0; i < terms.rows; ++i) {
      const Vec3& point = points[static_cast<std::size_t>(i)];
      terms(i, 0) = point.x();
      terms(i, 1) = point.y();
      terms(i, 2) = 1.0;
      heights(i, 0) = point.z();
    }
    cv::Mat1d plane;
    cv::solve(terms, heights, plane, cv::DECOMP_SVD);
    return cv::norm(terms * plane, heights, cv::NORM_INF);
  }

 private:
  std::vector<std::array<Vec3, 4>> corners_mm_;
  double scale_ = 1.0;
};

std::vector<Vec3> disc_about(const Vec3& centre_mm) {
  constexpr int kSides = 360;
  std::vector<Vec3> outline;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    outline.push_back(centre_mm + kDishRadiusMm * Vec3(std::cos(angle), std::sin(angle), 0.0));
  }
  return outline;
}

double distance_mm(const std::vector<Vec3>& rectangle, const Vec3& point_mm) {
  const Vec3 middle = 0.5 * (rectangle[0] + rectangle[2]);
  const Vec3 half = 0.5 * (rectangle[2] - rectangle[0]).cwiseAbs();
  return ((point_mm - middle).cwiseAbs() - half).cwiseMax(0.0).head<2>().norm();
}

std::vector<cv::Point> pixels_of(const TrueView& view, const std::vector<Vec3>& points_mm) {
  std::vector<cv::Point> pixels;
  for (const Vec3& point_mm : points_mm) {
    const Vec3 seen = view.camera_from_world * point_mm;
    const Vec2 pixel = view.lens.pixel(seen.hnormalized());
    pixels.emplace_back(cvRound(pixel.x()), cvRound(pixel.y()));
  }
  return pixels;
}

// A photograph with the fruit's silhouette.
struct Sight {
  const TrueView* view = nullptr;
  cv::Mat1b silhouette;
};

Sight look(const std::vector<TrueView>& views, const std::string& image) {
  const auto is_named = [&](const TrueView& view) { return view.image.filename() == image; };
  const TrueView& view = *std::find_if(views.begin(), views.end(), is_named);
  const auto silhouette = view.image.parent_path() / ("mask_" + view.image.stem().string() + ".png");
  Sight sight{&view, cv::imread(silhouette.string(), cv::IMREAD_GRAYSCALE)};
  cv::threshold(sight.silhouette, sight.silhouette, 127, 255, cv::THRESH_BINARY);
  return sight;
}

bool is_seen_whole(const Sight& sight, const std::vector<Vec3>& outline_mm) {
  const std::vector<cv::Point> outline = pixels_of(*sight.view, outline_mm);
  const cv::Rect inner(kPictureMarginPx, kPictureMarginPx, sight.silhouette.cols - 2 * kPictureMarginPx,
                       sight.silhouette.rows - 2 * kPictureMarginPx);
  if ((cv::boundingRect(outline) & inner) != cv::boundingRect(outline)) return false;
  cv::Mat1b covered(sight.silhouette.size(), std::uint8_t{0});
  cv::fillConvexPoly(covered, outline, 255);
  constexpr int kSide = 2 * kFruitMarginPx + 1;
  cv::dilate(covered, covered, cv::Mat1b(kSide, kSide, std::uint8_t{1}));
  return cv::countNonZero(covered & sight.silhouette) == 0;
}

std::optional<Markers> choose_card(const Page& page, const Vec3& centre_mm,
                                   const std::array<Sight, 2>& sights) {
  std::optional<Markers> best;
  for (int row = 0; row + 1 < test::kMarkersDownPage; ++row) {
    for (int column = 0; column + 1 < test::kMarkersAcrossPage; ++column) {
      const std::vector<Vec3> outline = page.outline_of({row, column});
      if (distance_mm(outline, centre_mm) < kDishRadiusMm + kCardMarginMm) continue;
      if (!is_seen_whole(sights[0], outline) || !is_seen_whole(sights[1], outline)) continue;
      if (!best || page.bend_mm({row, column}) < page.bend_mm(*best)) best = {row, column};
    }
  }
  return best;
}

nlohmann::json camera_of(const Sight& sight) {
  const LensModel& lens = sight.view->lens;
  return {{"width", sight.silhouette.cols},
          {"height", sight.silhouette.rows},
          {"fx", lens.pinhole.fx_px},
          {"fy", lens.pinhole.fy_px},
          {"cx", lens.pinhole.cx_px},
          {"cy", lens.pinhole.cy_px},
          {"distortion", {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3}}};
}

nlohmann::json pose_of(const Sight& sight) {
  const Pose& pose = sight.view->camera_from_world;
  nlohmann::json rows;
  for (int i = 0; i < 3; ++i)
    rows.push_back({pose.rotation(i, 0), pose.rotation(i, 1), pose.rotation(i, 2), pose.translation[i]});
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

cv::Mat1b draw_labels(const Sight& sight, const std::vector<Vec3>& dish_mm,
                      const std::vector<Vec3>& card_mm) {
  cv::Mat1b labels(sight.silhouette.size(), kBackgroundLabel);
  cv::fillConvexPoly(labels, pixels_of(*sight.view, dish_mm), kDishLabel);
  cv::fillConvexPoly(labels, pixels_of(*sight.view, card_mm), kCardLabel);
  labels.setTo(kFruit, sight.silhouette);
  return labels;
}

void write_json(const std::filesystem::path& file, const nlohmann::json& document) {
  std::ofstream(file) << document.dump(1) << '\n';
}

void write_capture(const std::filesystem::path& folder, const std::array<Sight, 2>& sights, const Page& page,
                   const Markers& card, const Vec3& centre_mm, const BoardFruit& fruit) {
  std::filesystem::create_directories(folder);
  cv::imwrite((folder / "card.png").string(), test::draw_marker_card(card.row, card.column));
  constexpr double kDishMm = 2.0 * kDishRadiusMm;
  nlohmann::json capture = {{"version", 1}, {"camera", camera_of(sights[0])}};
  capture["card"] = {{"pattern", "card.png"},
                     {"width_mm", page.card_mm()},
                     {"height_mm", page.card_mm()},
                     {"thickness_mm", 0.0}};
  capture["dish"] = {{"style", "page"},
                     {"outer_size_mm", {kDishMm, kDishMm}},
                     {"rim_height_mm", 0.0},
                     {"bottom_height_mm", 0.0},
                     {"profile", {{0.0, 0.0}, {1.0, 0.0}}}};
  nlohmann::json item = {{"label", kFruit}, {"name", "fruit"}, {"kind", "scan"}};
  item["volume_ml"] = fruit.closed_ml;
  item["column_volume_ml"] = fruit.column_ml;
  nlohmann::json truth;
  truth["items"].push_back(item);
  for (const Sight& sight : sights) {
    const std::string image = sight.view->image.filename().string();
    const std::string labels = "labels_" + sight.view->image.stem().string() + ".png";
    std::filesystem::copy_file(sight.view->image, folder / image,
                               std::filesystem::copy_options::overwrite_existing);
    cv::imwrite((folder / labels).string(), draw_labels(sight, disc_about(centre_mm), page.outline_of(card)));
    capture["views"].push_back({{"image", image}, {"labels", labels}, {"camera", camera_of(sight)}});
    truth["poses"].push_back(pose_of(sight));
  }
  write_json(folder / "capture.json", capture);
  write_json(folder / "truth.json", truth);
}

}  // namespace

std::size_t write_fruit_captures(const std::filesystem::path& board, const BoardFruit& fruit,
                                 const std::filesystem::path& set) {
  const nlohmann::json cameras = test::read_json(board / "cameras.json");
  const Page page(cameras.at("board_corners_fitted_mm"));
  const Vec3 centre_mm(cameras.at("object_centre")[0], cameras.at("object_centre")[1], 0.0);
  const std::vector<TrueView> views = test::read_real_views(board);
  std::size_t written = 0;
  for (const nlohmann::json& pair : cameras.at("pairs")) {
    const double angle_deg = pair.at("angle_at_object_deg");
    if (angle_deg < kLeastAngleDeg || angle_deg > kMostAngleDeg) continue;
    const std::array<Sight, 2> sights = {look(views, pair.at("a")), look(views, pair.at("b"))};
    const std::optional<Markers> card = choose_card(page, centre_mm, sights);
    if (!card) continue;
    const std::string name =
        sights[0].view->image.stem().string() + "_" + sights[1].view->image.stem().string();
    write_capture(set / name, sights, page, *card, centre_mm, fruit);
    ++written;
  }
  return written;
}

}  // namespace traygauge
