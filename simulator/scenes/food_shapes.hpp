// The shapes of foods, from a seed: each paints one food of about the given size about the origin. A piece of
// it has texture 0 to 3 of its kind.
#pragma once

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/food_painter.hpp"

namespace traygauge {

struct FoodSize {
  double length_mm = 0.0;
  double width_mm = 0.0;
  double height_mm = 0.0;  // of filled food: of what stands out of the liquid
};

using FoodShape = void (*)(FoodPainter& painter, Draws& draws, const FoodSize& size);

// Heaps of soft food.
void paint_mash(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_spinach(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_crumble(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_sauce(FoodPainter& painter, Draws& draws, const FoodSize& size);

// Heaps of pieces.
void paint_peas(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_rice(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_diced_vegetables(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_carrot_slices(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_meatballs(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_potatoes(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_stew(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_beans(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_gnocchi(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_nuggets(FoodPainter& painter, Draws& draws, const FoodSize& size);

// Heaps of rods and leaves.
void paint_fries(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_penne(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_spaghetti(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_slaw(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_green_beans(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_salad(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_broccoli(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_sausage(FoodPainter& painter, Draws& draws, const FoodSize& size);

// One flat piece.
void paint_schnitzel(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_steak(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_fish(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_patty(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_omelette(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_bread(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_chicken(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_pizza(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_cake(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_lasagne(FoodPainter& painter, Draws& draws, const FoodSize& size);

// Smooth, most of them white.
void paint_fried_egg(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_egg_halves(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_mozzarella_slices(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_mozzarella_ball(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_dumplings(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_cubes(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_smooth_heap(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_panna_cotta(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_asparagus(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_roll(FoodPainter& painter, Draws& draws, const FoodSize& size);

// What stands out of a liquid, above its level; the liquid itself has texture 0.
void paint_smooth_liquid(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_vegetable_soup(FoodPainter& painter, Draws& draws, const FoodSize& size);
void paint_chunky_soup(FoodPainter& painter, Draws& draws, const FoodSize& size);

}  // namespace traygauge
