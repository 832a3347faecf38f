// Dishes as TOML: written, and read back by the reader that checks what people write.
#include "firmware/config/dish_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "firmware/config/dish_library.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/png_writer.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

// Bit for bit: a dish is measured once and used for years.
void expect_same(const DishDescription& read, const DishDescription& written) {
  EXPECT_EQ(read.style, written.style);
  EXPECT_EQ(read.outer_size_mm, written.outer_size_mm);
  EXPECT_EQ(read.rim_height_mm, written.rim_height_mm);
  EXPECT_EQ(read.bottom_height_mm, written.bottom_height_mm);
  ASSERT_EQ(read.profile.size(), written.profile.size());
  for (std::size_t i = 0; i < read.profile.size(); ++i) {
    EXPECT_EQ(read.profile[i].inset_mm, written.profile[i].inset_mm) << i;
    EXPECT_EQ(read.profile[i].height_mm, written.profile[i].height_mm) << i;
  }
}

DishDescription draw_dish(std::mt19937& random) {
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  DishDescription dish;
  dish.outer_size_mm = {draw(20.0, 1000.0), draw(20.0, 1000.0)};
  dish.bottom_height_mm = draw(0.0, 50.0);
  dish.rim_height_mm = draw(dish.bottom_height_mm, 200.0);
  const std::size_t points = random() % (kMaxProfilePoints + 1);
  if (points < 2) return dish;
  const double half_mm = 0.5 * std::min(dish.outer_size_mm[0], dish.outer_size_mm[1]);
  for (std::size_t i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points - 1);
    dish.profile.push_back(
        {share * half_mm, dish.rim_height_mm + share * (dish.bottom_height_mm - dish.rim_height_mm)});
  }
  return dish;
}

TEST(DishFile, WhatIsWrittenIsReadBack) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "dish.toml";
  std::mt19937 random(test::random_seed());
  for (int round = 0; round < 200; ++round) {
    DishDescription dish = draw_dish(random);
    dish.style = round % 2 == 0 ? "soup" : "";
    write_dish_file(file, dish);
    expect_same(read_dish_file(file), dish);
    ASSERT_FALSE(::testing::Test::HasFailure()) << "round " << round << "\n" << read_text(file);
  }
}

TEST(DishFile, WholeNumbersAndAnyTextSurvive) {
  const TemporaryFolder folder;
  DishDescription dish{1, "Suppe \"gro\xc3\x9f\"\n\t\\ # [1]\x7f", {260.0, 1000.0}, 22.0, 0.0, {}};
  dish.profile = {{0.0, 22.0}, {1e-9, 21.0}, {49.0, 0.0}};
  write_dish_file(folder.path() / "dish.toml", dish);
  expect_same(read_dish_file(folder.path() / "dish.toml"), dish);
  dish.profile.clear();
  write_dish_file(folder.path() / "dish.toml", dish);
  expect_same(read_dish_file(folder.path() / "dish.toml"), dish);
}

TEST(DishFile, TheDishesOfTheCheckoutAreWrittenAsTheyAre) {
  const TemporaryFolder folder;
  for (const auto& entry : fs::directory_iterator(TRAYGAUGE_SOURCE_DIR "/config/dishes")) {
    const DishDescription dish = read_dish_file(entry.path());
    write_dish_file(folder.path() / "dish.toml", dish);
    expect_same(read_dish_file(folder.path() / "dish.toml"), dish);
    // A person wrote the first line.
    const auto below_first_line = [](const std::string& text) { return text.substr(text.find('\n')); };
    EXPECT_EQ(below_first_line(read_text(folder.path() / "dish.toml")),
              below_first_line(read_text(entry.path())));
  }
}

TEST(DishFile, IsReplacedAsAWhole) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "dishes");
  const fs::path file = folder.path() / "dishes" / "dish.toml";
  const DishDescription small{1, "small", {100.0, 100.0}, 20.0, 4.0, {}};
  const DishDescription large{1, "large", {300.0, 300.0}, 20.0, 4.0, {}};
  write_dish_file(file, large);
  write_dish_file(file, small);
  const auto library = read_dish_library(folder.path());  // nothing else is left in the folder
  ASSERT_EQ(library.size(), 1U);
  expect_same(library[0], small);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "dishes"), fs::directory_iterator()), 1);
}

TEST(DishFile, WhatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const DishDescription dish{1, "small", {100.0, 100.0}, 20.0, 4.0, {}};
  EXPECT_THROW(write_dish_file(folder.path() / "absent" / "dish.toml", dish), OutputError);
  fs::create_directory(folder.path() / "dish.toml");
  EXPECT_THROW(write_dish_file(folder.path() / "dish.toml", dish), OutputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(DishFile, OfAnotherVersionIsRefused) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "dish.toml";
  const std::string text = compose_dish_file({1, "small", {100.0, 100.0}, 20.0, 4.0, {}});
  const std::string line = "version = 1\n";
  const std::size_t place = text.find(line);
  ASSERT_NE(place, std::string::npos) << text;
  std::string other = text;
  write_text(file, other.erase(place, line.size()));
  EXPECT_EQ(read_dish_file(file).style, "small") << "of version 1, as are all that do not say it";
  for (const char* const version : {"version = 2\nnew_key = 3\n", "version = 0\n"}) {
    write_text(file, version + other);
    try {
      read_dish_file(file);
      ADD_FAILURE() << version;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problem().key, "version") << error.what();
    }
  }
}

TEST(DishFile, ProfilesBeyondTheLimitAreRefused) {
  const TemporaryFolder folder;
  DishDescription dish{1, "deep", {300.0, 300.0}, 64.0, 0.0, {}};
  for (int i = 0; i <= 32; ++i) dish.profile.push_back({2.0 * i, 64.0 - 2.0 * i});
  write_text(folder.path() / "dish.toml", compose_dish_file(dish));
  EXPECT_THROW(read_dish_file(folder.path() / "dish.toml"), InputError);
}

}  // namespace
}  // namespace traygauge
