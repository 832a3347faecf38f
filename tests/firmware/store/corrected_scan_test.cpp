#include "firmware/store/corrected_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using Random = std::mt19937_64;

std::vector<MeasuredItem> sample_items(Random& random) {
  std::vector<MeasuredItem> items;
  const int count = static_cast<int>(random() % 6);
  for (int i = 0; i < count; ++i) {
    MeasuredItem item;
    item.label = 2 + i;
    item.dish = 1;
    item.status = "ok";
    item.food = i % 2 == 0 ? "rice" : "";
    if (random() % 8 != 0) {
      item.volume_ml = std::uniform_real_distribution<double>(1.0, 400.0)(random);
      item.sigma_ml = 0.02 * *item.volume_ml;
    }
    items.push_back(item);
  }
  return items;
}

// Any action, about items that exist or not.
CorrectionAction any_action(const CorrectedScan& scan, Random& random) {
  const auto any_item = [&] {
    return scan.items.empty() || random() % 10 == 0 ? static_cast<int>(random() % 1010)
                                                    : scan.items[random() % scan.items.size()].label;
  };
  switch (random() % 8) {
    case 0:
      return RenameItem{any_item(), "soup"};
    case 1:
    case 2:
      return MergeItems{any_item(), {any_item()}};
    case 3:
      return MergeItems{any_item(), {any_item(), any_item()}};
    case 4:
    case 5:
      return SplitItem{any_item(), std::uniform_real_distribution<double>(-5.0, 200.0)(random), "peas"};
    case 6:
      return MarkItemWrong{any_item()};
    default:
      return MarkScanWrong{};
  }
}

double sum(const CorrectedScan& scan, std::optional<double> CorrectedItem::*quantity) {
  double total = 0.0;
  for (const CorrectedItem& item : scan.items) total += (item.*quantity).value_or(0.0);
  return total;
}

class CorrectionHistory {
 public:
  explicit CorrectionHistory(std::vector<MeasuredItem> items) : items_(std::move(items)) {}
  CorrectedScan now() const { return correct_scan(items_, corrections_); }
  // Whether it was added.
  bool add(const CorrectionAction& action) {
    if (!refuse_correction(now(), action).empty()) return false;
    corrections_.push_back({static_cast<int>(corrections_.size()) + 1, {}, "chef", "", action});
    return true;
  }

 private:
  std::vector<MeasuredItem> items_;
  std::vector<Correction> corrections_;
};

TEST(CorrectedScan, WithoutCorrectionsIsWhatWasMeasured) {
  Random random(random_seed());
  for (int run = 0; run < 100; ++run) {
    const std::vector<MeasuredItem> items = sample_items(random);
    const CorrectedScan scan = correct_scan(items, {});
    ASSERT_EQ(scan.items.size(), items.size());
    EXPECT_FALSE(scan.is_corrected || scan.is_wrong);
    for (std::size_t i = 0; i < items.size(); ++i) {
      EXPECT_EQ(scan.items[i].volume_ml, items[i].volume_ml);
      EXPECT_EQ(scan.items[i].measured_volume_ml, items[i].volume_ml);
      EXPECT_EQ(scan.items[i].food, items[i].food);
    }
  }
}

TEST(CorrectedScan, VolumesAndSigmasAddUpWhateverIsCorrected) {
  Random random(random_seed());
  int booked = 0;
  for (int run = 0; run < 500; ++run) {
    CorrectionHistory history(sample_items(random));
    const CorrectedScan measured = history.now();
    for (int i = 0; i < 20; ++i) {
      const CorrectedScan before = history.now();
      if (!history.add(any_action(before, random))) {
        ASSERT_EQ(history.now(), before);
        continue;
      }
      ++booked;
      const CorrectedScan after = history.now();
      ASSERT_NEAR(sum(after, &CorrectedItem::volume_ml), sum(measured, &CorrectedItem::volume_ml), 1e-9);
      ASSERT_NEAR(sum(after, &CorrectedItem::sigma_ml), sum(measured, &CorrectedItem::sigma_ml), 1e-9);
      ASSERT_TRUE(after.is_corrected);
      for (const CorrectedItem& item : after.items) {
        ASSERT_TRUE(!item.volume_ml || *item.volume_ml > 0.0);
        // What was measured stands beside it, unchanged.
        const auto same = std::find_if(measured.items.begin(), measured.items.end(),
                                       [&](const auto& other) { return other.label == item.label; });
        ASSERT_EQ(same == measured.items.end(), item.split_from.has_value());
        if (same == measured.items.end()) continue;
        ASSERT_EQ(item.measured_volume_ml, same->volume_ml);
        ASSERT_EQ(item.measured_sigma_ml, same->sigma_ml);
        ASSERT_EQ(item.measured_food, same->food);
      }
    }
  }
  EXPECT_GT(booked, 1000);
}

TEST(CorrectedScan, UndoRestoresExactlyStepByStep) {
  Random random(random_seed());
  int undone = 0;
  for (int run = 0; run < 200; ++run) {
    CorrectionHistory history(sample_items(random));
    std::vector<CorrectedScan> states = {history.now()};
    for (int i = 0; i < 30; ++i) {
      const bool undoes = states.size() > 1 && random() % 3 == 0;
      if (!undoes) {
        if (history.add(any_action(states.back(), random))) states.push_back(history.now());
        continue;
      }
      ASSERT_TRUE(history.add(UndoCorrection{states.back().holding.back()}));
      states.pop_back();
      ASSERT_EQ(history.now(), states.back());
      ++undone;
    }
    while (states.size() > 1) {
      ASSERT_TRUE(history.add(UndoCorrection{states.back().holding.back()}));
      states.pop_back();
      ASSERT_EQ(history.now(), states.back());
    }
    ASSERT_FALSE(history.now().is_corrected);
  }
  EXPECT_GT(undone, 100);
}

std::vector<MeasuredItem> three_items() {
  return {{2, 1, "ok", 100.0, 2.0, "rice"},
          {3, 1, "ok", 50.0, 1.0, "peas"},
          {4, 2, "view_hidden", std::nullopt, std::nullopt, "soup"}};
}

TEST(CorrectedScan, SaysWhatBecameOfItems) {
  CorrectionHistory history(three_items());
  ASSERT_TRUE(history.add(SplitItem{2, 25.0, "corn"}));
  ASSERT_TRUE(history.add(MergeItems{3, {1001}}));
  ASSERT_TRUE(history.add(RenameItem{3, "vegetables"}));
  ASSERT_TRUE(history.add(MarkItemWrong{2}));
  const CorrectedScan scan = history.now();
  ASSERT_EQ(scan.items.size(), 3U);
  EXPECT_DOUBLE_EQ(*scan.items[0].volume_ml, 75.0);
  EXPECT_DOUBLE_EQ(*scan.items[0].sigma_ml, 1.5);
  EXPECT_TRUE(scan.items[0].is_wrong);
  EXPECT_DOUBLE_EQ(*scan.items[1].volume_ml, 75.0);
  EXPECT_DOUBLE_EQ(*scan.items[1].measured_volume_ml, 50.0);
  EXPECT_EQ(scan.items[1].merged, std::vector<int>{1001});
  EXPECT_EQ(scan.items[1].food, "vegetables");
  EXPECT_EQ(scan.items[1].measured_food, "peas");
  EXPECT_EQ(scan.holding, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_DOUBLE_EQ(booked_volume_ml(scan), 75.0);
  ASSERT_TRUE(history.add(MarkScanWrong{}));
  EXPECT_DOUBLE_EQ(booked_volume_ml(history.now()), 0.0);
}

TEST(CorrectedScan, RefusesWhatMakesNoSense) {
  CorrectionHistory history(three_items());
  ASSERT_TRUE(history.add(MarkItemWrong{3}));
  const double nan = std::nan("");
  const std::vector<CorrectionAction> actions = {
      RenameItem{9, "soup"},     RenameItem{2, ""},
      RenameItem{2, "a\nb"},     RenameItem{2, std::string(201, 'a')},
      MergeItems{2, {}},         MergeItems{2, {2}},
      MergeItems{2, {9}},        MergeItems{2, {4}},
      MergeItems{2, {3}},        MergeItems{2, std::vector<int>(100'000, 3)},
      SplitItem{2, 0.0, ""},     SplitItem{2, 100.0, ""},
      SplitItem{2, -1.0, ""},    SplitItem{2, nan, ""},
      SplitItem{4, 1.0, ""},     SplitItem{9, 1.0, ""},
      SplitItem{2, 1.0, "\xff"}, MarkItemWrong{3},
      MarkItemWrong{9},          UndoCorrection{2}};
  for (const CorrectionAction& action : actions) {
    EXPECT_NE(refuse_correction(history.now(), action), "") << correction_json(action).substr(0, 80);
  }
  EXPECT_NE(refuse_correction(correct_scan({}, {}), UndoCorrection{1}), "");
}

TEST(Correction, ReadsBackWhatItWrote) {
  for (const CorrectionAction& action :
       {CorrectionAction(RenameItem{2, "Spätzle \"x\""}), CorrectionAction(MergeItems{2, {3, 1001}}),
        CorrectionAction(SplitItem{2, 40.1, ""}), CorrectionAction(SplitItem{2, 0.1 + 0.2, "peas"}),
        CorrectionAction(MarkItemWrong{7}), CorrectionAction(MarkScanWrong{}),
        CorrectionAction(UndoCorrection{3})}) {
    const Expected<CorrectionAction> read = parse_correction(correction_json(action));
    ASSERT_TRUE(read.ok()) << read.failure();
    EXPECT_EQ(*read, action) << correction_json(action);
  }
}

TEST(Correction, RefusesWhatIsNone) {
  for (const char* const text :
       {"", "[]", "{}", R"({"action":"explode"})", R"({"action":"rename","item":2})",
        R"({"action":"rename","item":"2","food":"x"})", R"({"action":"rename","item":2.5,"food":"x"})",
        R"({"action":"rename","item":-2,"food":"x"})", R"({"action":"rename","item":99999999999,"food":"x"})",
        R"({"action":"rename","item":18446744073709551615,"food":"x"})",
        R"({"action":"merge","item":2,"others":3})", R"({"action":"merge","item":2,"others":["3"]})",
        R"({"action":"split","item":2,"volume_ml":"4"})", R"({"action":"undo"})"}) {
    EXPECT_FALSE(parse_correction(text).ok()) << text;
  }
}

}  // namespace
}  // namespace traygauge::test
