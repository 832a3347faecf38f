// The proof bodies' sheets as a printer gets them: rendered by poppler and measured.
#include "firmware/card_sheet/body_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/card_sheet/body_command.hpp"
#include "firmware/card_sheet/page_ruler.hpp"
#include "firmware/command/program.hpp"
#include "simulator/bodies/body_texture.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr double kBodyDpi = 254.0;  // 10 pixels a millimetre
constexpr double kBodyPxPerMm = kBodyDpi / 25.4;

class PrintedBodies {
 public:
  explicit PrintedBodies(const SheetPaper& paper) { write_body_sheets(file(), paper); }

  // Counted from 0; the last one is followed by none.
  cv::Mat1b page(int number) const {
    const fs::path stem = folder_.path() / "page";
    const std::string page = std::to_string(number + 1);
    run(std::string(TRAYGAUGE_PDFTOPPM) + " -gray -png -singlefile -r 254 -f " + page + " -l " + page + " " +
        file().string() + " " + stem.string());
    return cv::imread(stem.string() + ".png", cv::IMREAD_GRAYSCALE);
  }
  std::string text() const {
    const fs::path text_file = folder_.path() / "text";
    run(std::string(TRAYGAUGE_PDFTOTEXT) + " -layout " + file().string() + " " + text_file.string());
    return read_text(text_file);
  }
  fs::path file() const { return folder_.path() / "bodies.pdf"; }

 private:
  static void run(const std::string& command) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
  TemporaryFolder folder_;
};

cv::Point pixel(const PagePoint& at) {
  return {static_cast<int>(std::lround(kBodyPxPerMm * at.x_mm - 0.5)),
          static_cast<int>(std::lround(kBodyPxPerMm * at.y_mm - 0.5))};
}

// How dark it is within 0.2 mm of a place: 0 is black.
int darkest_near(const cv::Mat1b& page, const PagePoint& at) {
  const cv::Point middle = pixel(at);
  double darkest = 255.0;
  cv::minMaxLoc(page(cv::Rect(middle.x - 2, middle.y - 2, 5, 5)), &darkest);
  return static_cast<int>(darkest);
}

int pages_of(const std::vector<PlacedPiece>& pieces) {
  int last = 0;
  for (const PlacedPiece& placed : pieces) last = std::max(last, placed.page);
  return last + 1;
}

TEST(BodySheet, PagesHaveTheirPapersSizeAndKeepToWhatPrintersPrint) {
  for (const SheetPaper& paper : {kA4Paper, kLetterPaper}) {
    const PrintedBodies sheets(paper);
    for (int number = 0; number < pages_of(lay_out_bodies(paper)); ++number) {
      cv::Mat1b page = sheets.page(number);
      ASSERT_NEAR(page.cols, kBodyPxPerMm * paper.width_mm, 1.0);
      ASSERT_NEAR(page.rows, kBodyPxPerMm * paper.height_mm, 1.0);
      EXPECT_GT(cv::countNonZero(page < 128), 100) << number;
      page(cv::Rect(60, 60, page.cols - 120, page.rows - 120)).setTo(255);
      EXPECT_EQ(cv::countNonZero(page < 255), 0) << "page " << number;
    }
  }
}

TEST(BodySheet, EveryPieceStandsOnAPageAndTouchesNoOther) {
  for (const SheetPaper& paper : {kA4Paper, kLetterPaper}) {
    const std::vector<PlacedPiece> all = lay_out_bodies(paper);
    std::size_t pieces = 0;
    for (const ProofBody& body : proof_bodies()) pieces += unfold(body).size();
    EXPECT_EQ(all.size(), pieces);
    struct Box {
      int page;
      cv::Rect2d rect;
    };
    std::vector<Box> boxes;
    for (const PlacedPiece& placed : all) {
      double left = 1e9;
      double top = 1e9;
      double right = 0.0;
      double bottom = 0.0;
      const auto add = [&](const NetPoint& at) {
        const PagePoint point = placed.on_page(at);
        left = std::min(left, point.x_mm);
        right = std::max(right, point.x_mm);
        top = std::min(top, point.y_mm);
        bottom = std::max(bottom, point.y_mm);
      };
      for (const NetFace& face : placed.piece.faces) std::ranges::for_each(face.net, add);
      for (const GlueTab& tab : placed.piece.tabs) std::ranges::for_each(tab, add);
      EXPECT_GE(left, 7.9);
      EXPECT_LE(right, paper.width_mm - 7.9);
      EXPECT_GE(top, 32.0);  // below the ruler
      EXPECT_LE(bottom, paper.height_mm - 7.9);
      const cv::Rect2d rect(left, top, right - left, bottom - top);
      for (const Box& other : boxes) {
        if (other.page != placed.page) continue;
        EXPECT_EQ((other.rect & rect).area(), 0.0) << placed.body->id;
      }
      boxes.push_back({placed.page, rect});
    }
  }
}

// The rulers' first and last ticks, 100 mm apart, on every page.
TEST(BodySheet, EachPageHasARulerOf100Mm) {
  const PrintedBodies sheets(kA4Paper);
  for (int number = 0; number < pages_of(lay_out_bodies(kA4Paper)); ++number) {
    const cv::Mat1b page = sheets.page(number);
    // Its base line: the longest dark run of the page's upper part.
    int longest = 0;
    for (int y = 200; y < 500; ++y) {
      int run = 0;
      for (int x = 0; x < page.cols; ++x) {
        run = page(y, x) < 160 ? run + 1 : 0;
        longest = std::max(longest, run);
      }
    }
    // The ticks at both ends are 0.2 mm wide: half of that stands out on each side.
    EXPECT_NEAR(longest, 1002, 2) << number;
  }
}

// Cut lines and squares stand where the net says, which folds to the body.
TEST(BodySheet, NetsArePrintedInTheirSize) {
  const PrintedBodies sheets(kLetterPaper);
  int number = -1;
  cv::Mat1b page;
  for (const PlacedPiece& placed : lay_out_bodies(kLetterPaper)) {
    if (placed.page != number) page = sheets.page(number = placed.page);
    for (const NetPolygon& cut : placed.piece.cuts) {
      for (const NetPoint& corner : cut)
        EXPECT_LT(darkest_near(page, placed.on_page(corner)), 170) << placed.body->id;
    }
    if (!placed.piece.is_textured) continue;
    // Middles of squares well inside of a face.
    int squares = 0;
    for (const NetFace& face : placed.piece.faces) {
      NetPoint middle = NetPoint::Zero();
      for (const NetPoint& corner : face.net) middle += corner / static_cast<double>(face.net.size());
      if (placed.body->kind == BodyKind::cone && placed.number == 0) middle = {0.0, 60.0};
      for (int step = -2; step <= 2; ++step) {
        const int column = static_cast<int>(std::floor(middle.x() / kBodyCellMm)) + step;
        const int row = static_cast<int>(std::floor(middle.y() / kBodyCellMm));
        const PagePoint at = placed.on_page({kBodyCellMm * (column + 0.5), kBodyCellMm * (row + 0.5)});
        EXPECT_NEAR(page(pixel(at)), body_cell_gray(placed.body->id, placed.number, column, row), 3)
            << placed.body->id;
        ++squares;
      }
    }
    EXPECT_GT(squares, 0);
  }
}

// Lengths that a caliper would find on the finished body, between corners of the drawn net.
TEST(BodySheet, LengthsOnThePageAreTheBodys) {
  for (const PlacedPiece& placed : lay_out_bodies(kLetterPaper)) {
    for (const NetFace& face : placed.piece.faces) {
      for (std::size_t i = 1; i < face.corners_mm.size(); ++i) {
        const PagePoint from = placed.on_page(face.net[i - 1]);
        const PagePoint to = placed.on_page(face.net[i]);
        EXPECT_NEAR(std::hypot(to.x_mm - from.x_mm, to.y_mm - from.y_mm),
                    (face.corners_mm[i] - face.corners_mm[i - 1]).norm(), 1e-9);
      }
    }
  }
}

TEST(BodySheet, SaysIdAndVolume) {
  const std::string text = PrintedBodies(kA4Paper).text();
  for (const ProofBody& body : proof_bodies()) {
    EXPECT_NE(text.find(std::string(body.id)), std::string::npos);
    std::ostringstream volume;
    volume.precision(1);
    volume << std::fixed << body_volume_ml(body.kind, body.size_mm) << " ml";
    EXPECT_NE(text.find(volume.str()), std::string::npos) << volume.str();
  }
  for (const char* said : {"100 %", "paper of 120 to 200 g/m²", "measured_mm"})
    EXPECT_NE(text.find(said), std::string::npos) << said;
}

struct BodiesRun {
  int status = 0;
  std::string out;
  std::string error;
};

BodiesRun run_bodies_program(const std::vector<std::string>& arguments) {
  std::vector<const char*> pointers = {"traygauge-card", "verify", "bodies"};
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  Program program("Makes what is printed.", "traygauge");
  BodyOptions options;
  add_bodies_command(program, options);
  std::ostringstream out;
  std::ostringstream error;
  const int status = program.run(
      static_cast<int>(pointers.size()), pointers.data(), [&] { return run_bodies(options, out); }, out,
      error);
  return {status, out.str(), error.str()};
}

TEST(BodySheet, TheCommandWritesThePdfOrSaysWhyNot) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "b.pdf";
  const BodiesRun made = run_bodies_program({"-o", file.string(), "--paper", "letter"});
  EXPECT_EQ(made.status, 0) << made.error;
  EXPECT_NE(made.out.find("T169, truncated cone: 168.8 ml"), std::string::npos) << made.out;
  EXPECT_EQ(read_text(file).substr(0, 5), "%PDF-");
  for (const auto& wrong : std::vector<std::vector<std::string>>{
           {"--paper", "a3"}, {"-o", (folder.path() / "none" / "b.pdf").string()}, {"word"}}) {
    const BodiesRun run = run_bodies_program(wrong);
    EXPECT_EQ(run.status, 2) << wrong[0];
    EXPECT_EQ(std::ranges::count(run.error, '\n'), 1) << run.error;
  }
}

}  // namespace
}  // namespace traygauge
