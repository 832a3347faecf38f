#include "firmware/hub/shape_shelf.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "firmware/hub/scan_shape_reader.hpp"
#include "tests/firmware/store/sample_shape.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

ScanId id_of(std::uint64_t number) {
  return {"kitchen", number};
}

TEST(ShapeShelf, KeepsTheLastOnes) {
  ShapeShelf shelf({.max_shapes = 3});
  for (std::uint64_t i = 1; i <= 5; ++i) ASSERT_TRUE(shelf.put(id_of(i), sample_shape(id_of(i)).dump()).ok());
  for (std::uint64_t i = 1; i <= 5; ++i) EXPECT_EQ(shelf.find(id_of(i)) != nullptr, i > 2) << i;
}

TEST(ShapeShelf, KeepsNoMoreBytesThanItMay) {
  const std::size_t bytes = sample_shape(id_of(1)).dump().size();
  ShapeShelf shelf({.max_bytes = 2 * bytes + bytes / 2});
  for (std::uint64_t i = 1; i <= 5; ++i) ASSERT_TRUE(shelf.put(id_of(i), sample_shape(id_of(i)).dump()).ok());
  for (std::uint64_t i = 1; i <= 5; ++i) EXPECT_EQ(shelf.find(id_of(i)) != nullptr, i > 3) << i;
}

TEST(ShapeShelf, AnotherShapeOfAScanTakesThePlaceOfTheFirst) {
  ShapeShelf shelf({.max_shapes = 2});
  Json other = sample_shape(id_of(1));
  other["dishes"][0]["cell_mm"] = 3.0;
  ASSERT_TRUE(shelf.put(id_of(1), sample_shape(id_of(1)).dump()).ok());
  ASSERT_TRUE(shelf.put(id_of(2), sample_shape(id_of(2)).dump()).ok());
  ASSERT_TRUE(shelf.put(id_of(1), other.dump()).ok());
  EXPECT_EQ(*shelf.find(id_of(1)), other.dump());
  EXPECT_NE(shelf.find(id_of(2)), nullptr);
}

TEST(ShapeShelf, RefusesTheShapeOfAnotherScan) {
  ShapeShelf shelf;
  EXPECT_FALSE(shelf.put(id_of(1), sample_shape(id_of(2)).dump()).ok());
  EXPECT_EQ(shelf.find(id_of(1)), nullptr);
}

// Every part of a shape, absent and of four wrong types.
TEST(ShapeShelf, RefusesWhatIsNoShape) {
  const Json whole = sample_shape(id_of(1));
  const std::vector<Json> wrong = {nullptr, "text", -1, Json::object()};
  int refused = 0;
  const auto refuses = [&](const Json& json, const std::string& what) {
    EXPECT_FALSE(read_shape(json.dump()).ok()) << what << ": " << json.dump();
    ++refused;
  };
  for (const auto& [key, value] : whole.items()) {
    Json shape = whole;
    shape.erase(key);
    refuses(shape, key);
    for (const Json& other : wrong) {
      if (key == "id" && other.is_string()) continue;
      shape[key] = other;
      refuses(shape, key);
    }
  }
  for (const auto& [key, value] : whole["dishes"][0].items()) {
    Json shape = whole;
    shape["dishes"][0].erase(key);
    refuses(shape, key);
    for (const Json& other : wrong) {
      shape["dishes"][0][key] = other;
      refuses(shape, key);
    }
    if (!value.is_array()) continue;
    shape["dishes"][0][key] = value;
    shape["dishes"][0][key].push_back(1);
    refuses(shape, key);
  }
  for (const char* text : {"", "{", "[]", "7", "null"}) EXPECT_FALSE(read_shape(text).ok()) << text;
  EXPECT_GE(refused, 40);
}

TEST(ShapeShelf, RefusesMoreCellsThanThereCanBe) {
  Json shape = sample_shape(id_of(1));
  shape["dishes"][0]["columns"] = 1'000'000'000;
  EXPECT_FALSE(read_shape(shape.dump()).ok());
}

}  // namespace
}  // namespace traygauge::test
