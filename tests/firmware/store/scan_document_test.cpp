#include "firmware/store/scan_document.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "firmware/store/search_text.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using SampleJson = nlohmann::ordered_json;

SampleJson sample_json() {
  return SampleJson::parse(sample_document(17));
}

TEST(ScanDocument, ReadsWhatAStationHandsOver) {
  SampleScan scan;
  scan.id = {"kitchen-2", 18};
  scan.supersedes = ScanId{"kitchen-2", 16};
  scan.clock_synchronised = false;
  const Expected<ScanDocument> read = read_scan_document(sample_document(scan));
  ASSERT_TRUE(read.ok()) << read.failure();
  EXPECT_EQ(read->id, scan.id);
  EXPECT_EQ(read->supersedes, scan.supersedes);
  EXPECT_EQ(read->taken_ms, scan.taken_ms);
  EXPECT_FALSE(read->clock_synchronised);
  EXPECT_EQ(read->tray, "tray 12");
  EXPECT_EQ(read->status, "ok");
  ASSERT_EQ(read->items.size(), 4U);
  EXPECT_EQ(read->items[1].label, 3);
  EXPECT_EQ(read->items[1].food, "peas");
  EXPECT_DOUBLE_EQ(read->items[1].volume_ml.value_or(0), 83.25 + 31.125);
}

TEST(ScanDocument, WhatWasNotMeasuredHasNoVolume) {
  SampleJson json = sample_json();
  json["tray"] = nullptr;
  json["items"][0]["volume_ml"] = nullptr;
  json["items"][0]["sigma_ml"] = nullptr;
  json["items"][0].erase("food");
  const Expected<ScanDocument> read = read_scan_document(json.dump());
  ASSERT_TRUE(read.ok()) << read.failure();
  EXPECT_EQ(read->tray, "");
  EXPECT_EQ(read->items[0].volume_ml, std::nullopt);
  EXPECT_EQ(read->items[0].sigma_ml, std::nullopt);
  EXPECT_EQ(read->items[0].food, "");
}

// A change to a sound document, and what the refusal has to name.
struct Flaw {
  const char* path;
  SampleJson value;
  const char* named;
};

TEST(ScanDocument, ARefusalNamesTheKeyAndWhatWasExpected) {
  for (const Flaw& flaw :
       {Flaw{"/version", 3, "key version: expected 2, found 3"},
        {"/version", "2", "key version"},
        {"/id", "kitchen-017", "key id: expected a scan's id"},
        {"/id", nullptr, "key id: expected text, found null"},
        {"/station", "bakery", "key station: expected the station of kitchen-17"},
        {"/number", 18, "key number: expected the number of kitchen-17"},
        {"/taken_at", "today", "key taken_at"},
        {"/clock_synchronised", 1, "key clock_synchronised: expected true or false"},
        {"/supersedes", "kitchen-17", "key supersedes: expected an earlier scan"},
        {"/supersedes", "bakery-16", "key supersedes"},
        {"/supersedes", "", "key supersedes"},
        {"/tray", 7, "key tray"},
        {"/status", SampleJson::array(), "key status"},
        {"/message", nullptr, "key message"},
        {"/items", SampleJson::object(), "key items: expected a list"},
        {"/items/1", 5, "key items: expected a list of objects"},
        {"/items/1/label", -2, "key items[1].label"},
        {"/items/1/label", 2, "key items[1].label: expected a label that no other item has"},
        {"/items/1/volume_ml", "12", "key items[1].volume_ml: expected a number or null"},
        {"/items/1/food", 5, "key items[1].food"}}) {
    SampleJson json = sample_json();
    json[SampleJson::json_pointer(flaw.path)] = flaw.value;
    const Expected<ScanDocument> read = read_scan_document(json.dump());
    ASSERT_FALSE(read.ok()) << flaw.path << " " << flaw.value;
    EXPECT_NE(read.failure().find(flaw.named), std::string::npos) << read.failure();
  }
}

TEST(ScanDocument, RefusesWhatIsNoDocument) {
  const std::string deep = std::string(500'000, '[');
  for (const std::string& text :
       {std::string(), std::string("null"), std::string("[]"), std::string("{"), std::string("{}x"), deep,
        std::string(R"({"version":1e999})"), "{\"id\":\"\xff\"}" + std::string(),
        "{\"a\":\"" + std::string(kMaxScanDocumentBytes, 'a') + "\"}"}) {
    EXPECT_FALSE(read_scan_document(text).ok()) << text.substr(0, 40);
  }
}

// Nothing that a wire can do to a document is more than a refusal.
TEST(ScanDocument, DamagedBytesAreReadOrRefused) {
  std::mt19937_64 random(random_seed());
  const std::string sound = sample_document(17);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = sound;
    for (std::uint64_t flaws = 1 + random() % 3; flaws > 0; --flaws) {
      text[random() % text.size()] = static_cast<char>(random());
    }
    if (random() % 4 == 0) text.resize(random() % text.size());
    refused += read_scan_document(text).ok() ? 0 : 1;
  }
  EXPECT_GT(refused, 500);
}

TEST(ScanDocument, TheSameIsTheSameHoweverItIsWritten) {
  const std::string text = sample_document(17);
  EXPECT_TRUE(is_same_document(text, text));
  EXPECT_TRUE(is_same_document(text, SampleJson::parse(text).dump(2)));
  EXPECT_TRUE(is_same_document(R"({"a":1,"b":2})", R"({"b":2,"a":1})"));
  EXPECT_FALSE(is_same_document(text, sample_document(18)));
  EXPECT_FALSE(is_same_document("no JSON", "nor this"));
  EXPECT_TRUE(is_same_document("no JSON", "no JSON"));
  // Comparing it would need as many levels of the stack.
  const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
  EXPECT_FALSE(is_same_document(deep, deep + " "));
}

TEST(PlainText, IsShortUtf8WithoutControlCharacters) {
  EXPECT_TRUE(is_plain_text("", 5));
  EXPECT_TRUE(is_plain_text("Spätzle \"fein\" \\ 1/2", 100));
  EXPECT_FALSE(is_plain_text("abc", 2));
  for (const char* const text : {"\xff", "a\nb", "\x7f", "\xc3", "\xed\xa0\x80"}) {
    EXPECT_FALSE(is_plain_text(text, 100)) << text;
  }
  EXPECT_FALSE(is_plain_text(std::string("a\0b", 3), 100));
}

TEST(SearchText, FoldsEnglishAndGermanLetters) {
  EXPECT_EQ(fold_case("Grüner KOHL, SPÄTZLE, Öl, ÇA × 2"), "grüner kohl, spätzle, öl, ça × 2");
  EXPECT_EQ(fold_case("Straße @[`{"), "straße @[`{");
}

}  // namespace
}  // namespace traygauge::test
