// Axes, histograms, charts.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "firmware/plot/axis.hpp"
#include "firmware/plot/chart.hpp"
#include "firmware/plot/histogram.hpp"
#include "firmware/plot/svg.hpp"
#include "tests/firmware/evaluate/xml_check.hpp"

namespace traygauge {
namespace {

TEST(Axis, TicksStandAtRoundNumbers) {
  const Axis axis = make_axis("x", -3.0, 47.0, 6);
  EXPECT_EQ(axis.ticks, (std::vector<double>{-10.0, 0.0, 10.0, 20.0, 30.0, 40.0, 50.0}));
  EXPECT_EQ(axis.decimals, 0);
  const Axis fine = make_axis("x", 0.0, 0.55, 6);
  EXPECT_EQ(fine.ticks.size(), 7U);
  EXPECT_NEAR(fine.high, 0.6, 1e-12);
  EXPECT_EQ(fine.decimals, 1);
}

TEST(Axis, RoundStepIsTheNextOfOneTwoFive) {
  EXPECT_NEAR(round_step(0.2), 0.2, 1e-15);
  EXPECT_NEAR(round_step(0.21), 0.5, 1e-15);
  EXPECT_NEAR(round_step(51.0), 100.0, 1e-12);
  EXPECT_NEAR(round_step(1000.0), 1000.0, 1e-9);
}

TEST(Axis, AnEmptySpanBecomesOne) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  for (const Axis& axis :
       {make_axis("x", 3.0, 3.0), make_axis("x", -endless, endless), make_axis("x", 5.0, 1.0)}) {
    EXPECT_GT(axis.high, axis.low);
    EXPECT_GE(axis.ticks.size(), 2U);
    EXPECT_LE(axis.ticks.size(), 20U);
  }
}

TEST(Axis, LogarithmicTicksEncloseTheSpan) {
  const Axis axis = make_logarithmic_axis("x", 28.0, 460.0);
  EXPECT_EQ(axis.ticks, (std::vector<double>{20.0, 50.0, 100.0, 200.0, 500.0}));
  EXPECT_NEAR(axis.place(100.0), 0.5, 1e-12);
  EXPECT_EQ(axis.place(-7.0), 0.0);
  EXPECT_EQ(axis.place(1e9), 1.0);
  EXPECT_EQ(make_logarithmic_axis("x", 10.0, 10.0).ticks, (std::vector<double>{10.0, 20.0}));
  EXPECT_EQ(make_logarithmic_axis("x", 0.3, 3.0).decimals, 1);
}

TEST(Histogram, CountsEveryValueOnce) {
  const Histogram histogram =
      make_histogram({-11.0, -10.0, -0.1, 0.0, 4.9, 5.0, 10.0, 10.1}, -10.0, 10.0, 5.0);
  EXPECT_EQ(histogram.counts, (std::vector<int>{1, 1, 2, 2}));
  EXPECT_EQ(histogram.below, 1);
  EXPECT_EQ(histogram.above, 1);
  EXPECT_EQ(histogram.total, 8);
  EXPECT_EQ(histogram.largest_share_percent(), 25.0);
}

TEST(Chart, IsWellFormedWhateverItsTextsSay) {
  Chart chart("a < b & \"c\" > d", "e\nf", make_axis("<x>", 0.0, 1.0), make_axis("y & z", 0.0, 1.0));
  chart.bars(make_histogram({0.1, 0.2, 0.9}, 0.0, 1.0, 0.1), kBlue);
  chart.markers({{0.5, 0.5}, {9.0, -9.0}}, {Marker::square, kOrange}, "beyond <1>");
  chart.line({{0.0, 0.0}, {1.0, 1.0}}, {kBlack, 1.0, "2 2"}, "&");
  const std::string svg = chart.str();
  EXPECT_EQ(find_xml_fault(svg), "");
  EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot; &gt; d"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Chart, PointsBeyondStandAtTheEdge) {
  const Axis axis = make_axis("x", 0.0, 10.0, 5);
  Chart inside("t", "", axis, axis);
  inside.markers({{10.0, 0.0}}, {}, "");
  Chart beyond("t", "", axis, axis);
  beyond.markers({{1e6, -1e6}}, {}, "");
  EXPECT_EQ(inside.str(), beyond.str());
}

TEST(Chart, LinesBeyondAreLeftOut) {
  const Axis axis = make_axis("x", 0.0, 10.0, 5);
  const std::string bare = Chart("t", "", axis, axis).str();
  Chart chart("t", "", axis, axis);
  chart.vertical(11.0, {}, "limit");
  chart.vertical(std::nan(""), {}, "limit");
  chart.horizontal(-1.0, {}, "limit");
  EXPECT_EQ(chart.str(), bare);
  chart.vertical(10.0, {}, "limit");
  EXPECT_NE(chart.str(), bare);
}

TEST(Chart, AnEmptyOneSaysSo) {
  const std::string svg = compose_empty_chart("Title", "No data.");
  EXPECT_EQ(find_xml_fault(svg), "");
  EXPECT_NE(svg.find("No data."), std::string::npos);
}

TEST(XmlCheck, FindsFaults) {
  const std::string start = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>";
  EXPECT_EQ(find_xml_fault(start + "<a b=\"c\"><d/>text</a>\n"), "");
  for (const char* fault :
       {"<a>", "<a></b>", "<a b=c/>", "<a>x & y</a>", "<a/><b/>", "<a b=\"<\"/>", "text", ""})
    EXPECT_NE(find_xml_fault(start + fault), "") << fault;
}

}  // namespace
}  // namespace traygauge
