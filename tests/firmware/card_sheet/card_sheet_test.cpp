// The sheet as a printer gets it: rendered by poppler and measured.
#include "firmware/card_sheet/card_sheet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "firmware/card/card_drawing.hpp"
#include "simulator/capture/output_file.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr int kPxPerMm = 50;
constexpr const char* kDotsPerInch = "1270";
constexpr double kToleranceMm = 0.05;

// A sheet, and pictures of parts of it.
class PrintedSheet {
 public:
  PrintedSheet(int pattern, const SheetPaper& paper) : layout(lay_out_sheet(paper)) {
    write_card_sheet(sheet(), pattern, paper);
  }

  cv::Mat1b whole(int dots_per_inch) { return show("-r " + std::to_string(dots_per_inch)); }
  // From that point on; its distances to the part's edges are a fraction of a pixel.
  cv::Mat1b part(PagePoint corner, double width_mm, double height_mm) {
    const auto px = [](double mm) { return std::to_string(std::lround(kPxPerMm * mm)); };
    return show(std::string("-r ") + kDotsPerInch + " -x " + px(corner.x_mm) + " -y " + px(corner.y_mm) +
                " -W " + px(width_mm) + " -H " + px(height_mm));
  }
  std::string text() {
    const fs::path file = folder_.path() / "text";
    run(std::string(TRAYGAUGE_PDFTOTEXT) + " " + sheet().string() + " " + file.string());
    return read_text(file);
  }

  const SheetLayout layout;

 private:
  fs::path sheet() const { return folder_.path() / "card.pdf"; }
  cv::Mat1b show(const std::string& options) {
    const fs::path stem = folder_.path() / "page";
    run(std::string(TRAYGAUGE_PDFTOPPM) + " -gray -png -singlefile " + options + " " + sheet().string() +
        " " + stem.string());
    return cv::imread(stem.string() + ".png", cv::IMREAD_GRAYSCALE);
  }
  static void run(const std::string& command) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }

  TemporaryFolder folder_;
};

// Mean grey values along x, over the rows of a band.
std::vector<double> profile_of(const cv::Mat1b& picture, double top_mm, double bottom_mm) {
  const int top = static_cast<int>(kPxPerMm * top_mm);
  const int bottom = static_cast<int>(kPxPerMm * bottom_mm);
  cv::Mat1d means;
  cv::reduce(picture.rowRange(top, bottom), means, 0, cv::REDUCE_AVG, CV_64F);
  return {means.begin(), means.end()};
}

// Where the profile becomes darker than half, to a fraction of a pixel, in mm.
double first_dark_mm(const std::vector<double>& profile) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    if (profile[i] >= 127.5) continue;
    const double step = profile[i - 1] - profile[i];
    const double at = static_cast<double>(i) - 0.5 + (profile[i - 1] - 127.5) / step;
    return at / kPxPerMm;
  }
  return -1.0;
}

double dark_width_mm(std::vector<double> profile) {
  const double first = first_dark_mm(profile);
  std::reverse(profile.begin(), profile.end());
  return static_cast<double>(profile.size()) / kPxPerMm - first - first_dark_mm(profile);
}

// The middles of dark stretches, mm.
std::vector<double> ticks_of(const std::vector<double>& profile) {
  std::vector<double> ticks;
  double weight = 0.0;
  double moment = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double dark = 255.0 - profile[i];
    if (dark > 10.0) {
      weight += dark;
      moment += dark * (static_cast<double>(i) + 0.5);
    } else if (weight > 0.0) {
      ticks.push_back(moment / weight / kPxPerMm);
      weight = moment = 0.0;
    }
  }
  return ticks;
}

TEST(CardSheet, PagesHaveTheirPapersSize) {
  struct Case {
    SheetPaper paper;
    double width_mm;
    double height_mm;
  };
  for (const Case& page : {Case{kA4Paper, 210.0, 297.0}, Case{kLetterPaper, 8.5 * 25.4, 11.0 * 25.4}}) {
    PrintedSheet sheet(1, page.paper);
    const cv::Mat1b picture = sheet.whole(254);
    EXPECT_NEAR(picture.cols, 10.0 * page.width_mm, 1.0);
    EXPECT_NEAR(picture.rows, 10.0 * page.height_mm, 1.0);
    // Nothing lies where office printers cannot print.
    const cv::Rect printable(60, 60, picture.cols - 120, picture.rows - 120);
    cv::Mat1b border = picture.clone();
    border(printable).setTo(255);
    EXPECT_EQ(cv::countNonZero(border < 255), 0);
  }
}

TEST(CardSheet, BothSidesHaveTheCardsSize) {
  for (const SheetPaper& paper : {kA4Paper, kLetterPaper}) {
    PrintedSheet sheet(4, paper);
    for (const PagePoint& corner : {sheet.layout.front, sheet.layout.back}) {
      constexpr double kMarginMm = 1.0;
      const cv::Mat1b side = sheet.part({corner.x_mm - kMarginMm, corner.y_mm - kMarginMm},
                                        kCardWidthMm + 2.0 * kMarginMm, kCardHeightMm + 2.0 * kMarginMm);
      const std::vector<double> across = profile_of(side, 6.0, 50.0);
      EXPECT_NEAR(first_dark_mm(across), kMarginMm, kToleranceMm);
      EXPECT_NEAR(dark_width_mm(across), 85.60, kToleranceMm);
      const std::vector<double> down = profile_of(cv::Mat1b(cv::Mat(side.t())), 6.0, 80.0);
      EXPECT_NEAR(first_dark_mm(down), kMarginMm, kToleranceMm);
      EXPECT_NEAR(dark_width_mm(down), 53.98, kToleranceMm);
    }
  }
}

TEST(CardSheet, RulersAreTrue) {
  for (const SheetPaper& paper : {kA4Paper, kLetterPaper}) {
    PrintedSheet sheet(1, paper);
    // Above the short ticks, below the ends of the long ones.
    const auto long_ticks = [&](PagePoint zero, double length_mm) {
      return ticks_of(
          profile_of(sheet.part({zero.x_mm - 3.0, zero.y_mm - 5.0}, length_mm + 6.0, 5.0), 1.2, 1.8));
    };
    const std::vector<double> mm = long_ticks(sheet.layout.ruler, kRulerMm);
    ASSERT_EQ(mm.size(), 11U);
    EXPECT_NEAR(mm.front(), 3.0, kToleranceMm);
    for (std::size_t i = 1; i < mm.size(); ++i)
      EXPECT_NEAR(mm[i] - mm[0], 10.0 * static_cast<double>(i), kToleranceMm);
    const std::vector<double> inches = long_ticks(sheet.layout.inch_ruler, kInchRulerMm);
    ASSERT_EQ(inches.size(), paper.has_inches ? 5U : 0U);
    if (paper.has_inches) {
      EXPECT_NEAR(inches.back() - inches.front(), 101.6, kToleranceMm);
    }
    // All ticks, just above the base line.
    const cv::Mat1b band =
        sheet.part({sheet.layout.ruler.x_mm - 3.0, sheet.layout.ruler.y_mm - 2.0}, kRulerMm + 6.0, 2.0);
    EXPECT_EQ(ticks_of(profile_of(band, 0.4, 1.6)).size(), 101U);
  }
}

// The print, seen as coarsely as its picture.
TEST(CardSheet, PatternIsThatOfThePicture) {
  for (const int pattern : {1, kCardPatterns}) {
    PrintedSheet sheet(pattern, kA4Paper);
    const cv::Mat1b print = sheet.part(sheet.layout.front, kCardWidthMm, kCardHeightMm);
    cv::Mat1f ink;
    cv::Mat1b(255 - print).convertTo(ink, CV_32F, 1.0 / 255.0);
    cv::resize(ink, ink, {kCardPictureSize.width, kCardPictureSize.height}, 0.0, 0.0, cv::INTER_AREA);
    const Picture picture = card_picture(pattern);
    double sum = 0.0;
    int wrong = 0;
    for (int y = 0; y < picture.size.height; ++y) {
      for (int x = 0; x < picture.size.width; ++x) {
        const double gray = picture.gray().at(x, y);
        const double expected =
            (kPaperGray * kPaperGray - gray * gray) / (kPaperGray * kPaperGray - kInkGray * kInkGray);
        const double difference = std::abs(static_cast<double>(ink(y, x)) - expected);
        sum += difference;
        if (difference > 0.5) ++wrong;
      }
    }
    EXPECT_LT(sum / static_cast<double>(picture.pixels.size()), 0.01) << card_id(pattern);
    EXPECT_EQ(wrong, 0) << card_id(pattern);
  }
}

TEST(CardSheet, SaysHowToPrintAndWhichCardItIs) {
  PrintedSheet sheet(9, kLetterPaper);
  const std::string text = sheet.text();
  for (const char* part :
       {"Print at 100 % (actual size). Do not fit to page.", "Mit 100 % drucken. Nicht an Seite anpassen.",
        "TG-09", "85.60 × 53.98 mm", "This side down.", "Diese Seite nach unten."})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(CardSheet, FileThatCannotBeWrittenIsTold) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_card_sheet(folder.path() / "none" / "card.pdf", 1, kA4Paper), OutputError);
}

}  // namespace
}  // namespace traygauge
