#include "simulator/scenes/food_kinds.hpp"

#include <algorithm>
#include <vector>

namespace traygauge {
namespace {

constexpr FoodGroup kCanteen = FoodGroup::canteen;
constexpr FoodGroup kFastFood = FoodGroup::fast_food;
constexpr FoodGroup kOther = FoodGroup::other;
constexpr FoodServing kSolid = FoodServing::solid;
constexpr FoodServing kSoup = FoodServing::soup;
constexpr FoodServing kDessert = FoodServing::dessert;

// base, variant, patch, layer, grain, tone, speck colour, radius, share, coat, roughness.
std::vector<FoodKind> make_kinds() {
  return {
      {"mash", paint_mash, {92, 68, 34}, kCanteen, kSolid,
       {{{0xE8D9A8, 0xDCC483, 12, 0, 0.05F, 0, 0x4F6B2A, 0.7F, 0.12F, 0.02F, 0.55F}}}},
      {"polenta", paint_mash, {88, 66, 28}, kOther, kSolid,
       {{{0xE5B94A, 0xD7A12F, 9, 0, 0.10F, 0, 0xF2DC8C, 0.5F, 0.4F, 0.02F, 0.5F}}}},
      {"spinach", paint_spinach, {80, 62, 20}, kCanteen, kSolid,
       {{{0x35501C, 0x4F6E28, 5, 0, 0.20F, 0, 0x1E3010, 1.0F, 0.3F, 0.04F, 0.3F}}}},
      {"minced_meat", paint_crumble, {86, 66, 26}, kCanteen, kSolid,
       {{{0x7A4A2C, 0x5B341F, 6, 0, 0.15F, 0.25F, 0xA8401C, 1.2F, 0.15F, 0.03F, 0.4F}}}},
      {"couscous", paint_crumble, {84, 66, 30}, kOther, kSolid,
       {{{0xDDB868, 0xCFA24C, 5, 0, 0.12F, 0.15F, 0xB5482A, 1.4F, 0.12F, 0.02F, 0.6F}}}},
      {"mushroom_sauce", paint_sauce, {84, 62, 9}, kCanteen, kSolid,
       {{{0xC9A87A, 0xB89160, 9, 0, 0.05F, 0, 0x3D4A20, 0.6F, 0.1F, 0.04F, 0.18F},
         {0x9C7A55, 0x6E4E33, 5, 0, 0.1F, 0.2F, 0, 0, 0, 0.04F, 0.25F},
         {0x5D402A, 0x7D5A3A, 4, 0, 0.1F, 0.2F, 0, 0, 0, 0.04F, 0.25F}}}},
      {"bolognese", paint_sauce, {88, 66, 14}, kCanteen, kSolid,
       {{{0x9A2F14, 0x7E2410, 6, 0, 0.15F, 0, 0x5A2A16, 1.2F, 0.5F, 0.04F, 0.25F},
         {0x6E3A22, 0x85492C, 3, 0, 0.2F, 0.25F, 0, 0, 0, 0.03F, 0.4F},
         {0xC2551E, 0xA63E14, 3, 0, 0.1F, 0.2F, 0, 0, 0, 0.04F, 0.3F}}}},
      {"peas", paint_peas, {84, 64, 22}, kCanteen, kSolid,
       {{{0x6C9A2D, 0x5A8424, 6, 0, 0.05F, 0.18F, 0, 0, 0, 0.03F, 0.4F},
         {0x3C5A18, 0x46681C, 4, 0, 0.1F, 0, 0, 0, 0, 0.03F, 0.5F}}}},
      {"rice", paint_rice, {86, 72, 30}, kCanteen, kSolid,
       {{{0xEFE8D6, 0xE4DABF, 5, 0, 0.03F, 0.10F, 0, 0, 0, 0.03F, 0.45F},
         {0xC9BFA5, 0xBDB296, 4, 0, 0.05F, 0, 0, 0, 0, 0.02F, 0.6F}}}},
      {"tomato_rice", paint_rice, {86, 72, 28}, kOther, kSolid,
       {{{0xE0A060, 0xD4793A, 6, 0, 0.05F, 0.15F, 0x4F6B2A, 0.8F, 0.1F, 0.03F, 0.4F},
         {0xB2622C, 0xA6521E, 4, 0, 0.05F, 0, 0, 0, 0, 0.03F, 0.5F}}}},
      {"diced_vegetables", paint_diced_vegetables, {84, 64, 24}, kCanteen, kSolid,
       {{{0xE0832B, 0xCC6C1C, 5, 0, 0.06F, 0.1F, 0, 0, 0, 0.04F, 0.35F},
         {0x6F9B31, 0x557F22, 5, 0, 0.05F, 0.15F, 0, 0, 0, 0.04F, 0.35F},
         {0xE6D79A, 0xD9C57C, 5, 0, 0.06F, 0.1F, 0, 0, 0, 0.04F, 0.35F},
         {0x8A7A38, 0x7A6C30, 4, 0, 0.1F, 0, 0, 0, 0, 0.03F, 0.5F}}}},
      {"carrots", paint_carrot_slices, {84, 62, 22}, kCanteen, kSolid,
       {{{0xE07A22, 0xEE9A3E, 4, 0, 0.07F, 0.10F, 0x4F6B2A, 0.6F, 0.08F, 0.04F, 0.3F},
         {0xB65A14, 0xA65012, 4, 0, 0.1F, 0, 0, 0, 0, 0.04F, 0.4F}}}},
      {"meatballs", paint_meatballs, {92, 66, 32}, kCanteen, kSolid,
       {{{0x7A4426, 0x5A2E18, 5, 0, 0.15F, 0.12F, 0x2E180C, 0.8F, 0.2F, 0.03F, 0.4F},
         {0xA24A1E, 0x8C3C16, 7, 0, 0.06F, 0, 0, 0, 0, 0.04F, 0.2F}}}},
      {"potatoes", paint_potatoes, {100, 80, 36}, kCanteen, kSolid,
       {{{0xE3C878, 0xD2AF58, 8, 0, 0.07F, 0.07F, 0x3F5F22, 0.9F, 0.14F, 0.03F, 0.4F}}}},
      {"goulash", paint_stew, {88, 70, 30}, kCanteen, kSolid,
       {{{0x8C2E12, 0x74240E, 8, 0, 0.06F, 0, 0xC26A2A, 0.6F, 0.1F, 0.04F, 0.2F},
         {0x6A3820, 0x532A17, 4, 0, 0.15F, 0.15F, 0, 0, 0, 0.04F, 0.3F},
         {0xC04A20, 0xA83C18, 5, 0, 0.08F, 0.15F, 0, 0, 0, 0.04F, 0.25F}}}},
      {"chicken_curry", paint_stew, {88, 70, 28}, kCanteen, kSolid,
       {{{0xD09A30, 0xBD8424, 9, 0, 0.05F, 0, 0x6A4A18, 0.5F, 0.15F, 0.04F, 0.22F},
         {0xDDB570, 0xC99648, 5, 0, 0.1F, 0.1F, 0, 0, 0, 0.04F, 0.35F},
         {0xB23A20, 0x98301A, 5, 0, 0.06F, 0.15F, 0, 0, 0, 0.04F, 0.25F}}}},
      {"white_beans", paint_beans, {84, 64, 18}, kOther, kSolid,
       {{{0xE2CDA0, 0xD5BA84, 6, 0, 0.05F, 0.1F, 0, 0, 0, 0.04F, 0.3F},
         {0xB25426, 0xA44A20, 8, 0, 0.06F, 0, 0, 0, 0, 0.04F, 0.25F}}}},
      {"gnocchi", paint_gnocchi, {90, 68, 26}, kOther, kSolid,
       {{{0xE6CE90, 0xD9BA70, 7, 0, 0.05F, 0.07F, 0x8A6A2A, 0.7F, 0.15F, 0.03F, 0.4F},
         {0xB03A1C, 0x983016, 8, 0, 0.08F, 0, 0, 0, 0, 0.04F, 0.25F}}}},
      {"nuggets", paint_nuggets, {96, 76, 26}, kFastFood, kSolid,
       {{{0xC98A38, 0xA96A22, 6, 0, 0.2F, 0.08F, 0x7C4614, 0.8F, 0.3F, 0.02F, 0.6F},
         {0xA06A2A, 0x8A581E, 5, 0, 0.2F, 0, 0, 0, 0, 0.02F, 0.6F}}}},
      {"fries", paint_fries, {100, 76, 32}, kFastFood, kSolid,
       {{{0xEDC664, 0xDDA43E, 9, 0, 0.08F, 0.10F, 0xA8702A, 0.9F, 0.12F, 0.03F, 0.45F}}}},
      {"penne", paint_penne, {92, 74, 32}, kCanteen, kSolid,
       {{{0xE6C878, 0xDCB75E, 8, 0, 0.05F, 0.07F, 0xA83A1C, 0.8F, 0.2F, 0.04F, 0.3F},
         {0xB4502A, 0xA04420, 6, 0, 0.1F, 0, 0, 0, 0, 0.04F, 0.3F}}}},
      {"spaghetti", paint_spaghetti, {96, 80, 32}, kCanteen, kSolid,
       {{{0xEBD38C, 0xDFC070, 9, 0, 0.04F, 0.08F, 0, 0, 0, 0.04F, 0.3F},
         {0xB39450, 0xA58644, 5, 0, 0.06F, 0, 0, 0, 0, 0.03F, 0.45F}}}},
      {"coleslaw", paint_slaw, {82, 64, 24}, kFastFood, kSolid,
       {{{0xE4E2C0, 0xD0D49C, 5, 0, 0.04F, 0.08F, 0, 0, 0, 0.04F, 0.25F},
         {0xC9D68E, 0xDCE0B0, 5, 0, 0.04F, 0.1F, 0, 0, 0, 0.04F, 0.25F},
         {0xE2862E, 0xD2741E, 4, 0, 0.05F, 0.1F, 0, 0, 0, 0.04F, 0.3F}}}},
      {"red_cabbage", paint_slaw, {82, 64, 20}, kCanteen, kSolid,
       {{{0x6A1F44, 0x541636, 5, 0, 0.05F, 0.15F, 0, 0, 0, 0.04F, 0.25F},
         {0x7E2A54, 0x631C42, 5, 0, 0.05F, 0.15F, 0, 0, 0, 0.04F, 0.25F},
         {0x963C68, 0x7A2C54, 4, 0, 0.05F, 0.1F, 0, 0, 0, 0.04F, 0.25F}}}},
      {"green_beans", paint_green_beans, {90, 62, 22}, kOther, kSolid,
       {{{0x52782A, 0x3F6420, 8, 0, 0.06F, 0.14F, 0x7E9A48, 0.6F, 0.1F, 0.04F, 0.3F}}}},
      {"salad", paint_salad, {90, 72, 28}, kFastFood, kSolid,
       {{{0x6A9A36, 0x8DB857, 6, 0, 0.08F, 0.2F, 0, 0, 0, 0.04F, 0.3F},
         {0x3F6A22, 0x2F541A, 5, 0, 0.1F, 0.2F, 0, 0, 0, 0.04F, 0.3F},
         {0xC8321E, 0xDA5A34, 5, 0, 0.06F, 0.1F, 0xE8C070, 0.9F, 0.3F, 0.04F, 0.2F}}}},
      {"broccoli", paint_broccoli, {92, 70, 36}, kCanteen, kSolid,
       {{{0x3E6B22, 0x557F2E, 5, 0, 0.12F, 0.2F, 0, 0, 0, 0.02F, 0.55F},
         {0x2E4F18, 0x365C1C, 4, 0, 0.1F, 0, 0, 0, 0, 0.02F, 0.6F}}}},
      {"cauliflower", paint_broccoli, {92, 70, 34}, kCanteen, kSolid,
       {{{0xEDE4C6, 0xE0D4AC, 6, 0, 0.05F, 0.10F, 0x8A7A4A, 0.5F, 0.05F, 0.02F, 0.55F},
         {0xC9BF98, 0xBFB48A, 4, 0, 0.06F, 0, 0, 0, 0, 0.02F, 0.6F}}}},
      {"sausage", paint_sausage, {118, 30, 28}, kOther, kSolid,
       {{{0x9A4A24, 0x7C3416, 9, 0, 0.08F, 0, 0x4A200E, 1.2F, 0.15F, 0.04F, 0.25F}}}},
      {"schnitzel", paint_schnitzel, {112, 76, 12}, kCanteen, kSolid,
       {{{0xB4742A, 0x8E5018, 9, 0, 0.22F, 0, 0x5E3210, 0.8F, 0.35F, 0.03F, 0.5F}}}},
      {"steak", paint_steak, {104, 70, 19}, kCanteen, kSolid,
       {{{0x5E3422, 0x422014, 7, 0, 0.18F, 0, 0x22110A, 0.8F, 0.3F, 0.04F, 0.3F}}}},
      {"fish", paint_fish, {118, 56, 20}, kCanteen, kSolid,
       {{{0xE8CFA0, 0xC9954E, 12, 0, 0.10F, 0, 0x4F6B2A, 0.7F, 0.1F, 0.03F, 0.4F}}}},
      {"burger_patty", paint_patty, {92, 88, 16}, kFastFood, kSolid,
       {{{0x6A402A, 0x4C2A1A, 5, 0, 0.22F, 0, 0x2C160C, 1.0F, 0.3F, 0.03F, 0.4F}}}},
      {"omelette", paint_omelette, {124, 66, 18}, kOther, kSolid,
       {{{0xE8BE4A, 0xC98A2A, 14, 0, 0.06F, 0, 0x4F7A2A, 1.0F, 0.14F, 0.03F, 0.4F}}}},
      {"bread", paint_bread, {92, 78, 14}, kCanteen, kSolid,
       {{{0xC79A60, 0xB48248, 6, 0, 0.12F, 0, 0x7A5026, 1.1F, 0.35F, 0.01F, 0.7F}}}},
      {"chicken_leg", paint_chicken, {122, 62, 40}, kFastFood, kSolid,
       {{{0xB8742C, 0x8C4A16, 10, 0, 0.12F, 0, 0x4E240A, 0.8F, 0.2F, 0.04F, 0.25F},
         {0xE0CFAE, 0xC8B08A, 6, 0, 0.06F, 0, 0, 0, 0, 0.03F, 0.4F}}}},
      {"pizza", paint_pizza, {130, 108, 18}, kOther, kSolid,
       {{{0xE6C070, 0xC2481E, 9, 0, 0.08F, 0, 0x4F6B2A, 1.0F, 0.12F, 0.04F, 0.3F},
         {0xC28A42, 0x9C6024, 9, 0, 0.12F, 0, 0, 0, 0, 0.02F, 0.6F},
         {0xA0321E, 0xB84A32, 3, 0, 0.08F, 0.1F, 0xE0B0A0, 0.5F, 0.4F, 0.04F, 0.25F}}}},
      {"cake", paint_cake, {96, 62, 38}, kCanteen, kSolid,
       {{{0x5C3420, 0xEADFC8, 5, 11, 0.14F, 0, 0x2E180E, 0.9F, 0.25F, 0.02F, 0.55F}}}},
      {"lasagne", paint_lasagne, {96, 74, 34}, kOther, kSolid,
       {{{0xDDA94E, 0x9C3A18, 9, 9, 0.10F, 0, 0x6A3A12, 1.1F, 0.25F, 0.04F, 0.3F}}}},
      {"tomato_soup", paint_smooth_liquid, {160, 160, 0.5}, kCanteen, kSoup,
       {{{0xB83A16, 0xA83010, 16, 0, 0.03F, 0, 0xE0A060, 0.9F, 0.10F, 0.04F, 0.12F}}}},
      {"yoghurt", paint_smooth_liquid, {90, 90, 1.2}, kCanteen, kDessert,
       {{{0xEFEAE0, 0xE8E0D0, 14, 0, 0.015F, 0, 0x8A2040, 0.8F, 0.04F, 0.03F, 0.25F}}}},
      {"chocolate_pudding", paint_smooth_liquid, {90, 90, 0.8}, kCanteen, kDessert,
       {{{0x4A2816, 0x55301C, 12, 0, 0.03F, 0, 0, 0, 0, 0.04F, 0.22F}}}},
      {"vegetable_soup", paint_vegetable_soup, {150, 150, 0}, kCanteen, kSoup,
       {{{0xB08A3C, 0xA07A30, 14, 0, 0.04F, 0, 0x4F6B2A, 0.8F, 0.15F, 0.04F, 0.1F},
         {0xE0832B, 0xCC6C1C, 5, 0, 0.06F, 0.12F, 0, 0, 0, 0.04F, 0.3F},
         {0x6F9B31, 0x557F22, 5, 0, 0.06F, 0.15F, 0, 0, 0, 0.04F, 0.3F},
         {0xE6D79A, 0xD9C57C, 5, 0, 0.06F, 0.1F, 0, 0, 0, 0.04F, 0.3F}}}},
      {"goulash_soup", paint_chunky_soup, {150, 150, 0}, kCanteen, kSoup,
       {{{0x8C2E12, 0x74240E, 12, 0, 0.05F, 0, 0xC26A2A, 0.8F, 0.15F, 0.04F, 0.12F},
         {0x6A3820, 0x532A17, 4, 0, 0.15F, 0.15F, 0, 0, 0, 0.04F, 0.3F},
         {0xD9B25A, 0xC99A40, 6, 0, 0.06F, 0.1F, 0, 0, 0, 0.04F, 0.35F},
         {0xB03A18, 0x982E12, 5, 0, 0.08F, 0.15F, 0, 0, 0, 0.04F, 0.25F}}}},
      {"lentil_stew", paint_vegetable_soup, {150, 150, 0.5}, kOther, kSoup,
       {{{0x7A5428, 0x664420, 4, 0, 0.20F, 0, 0x4A3014, 1.3F, 0.7F, 0.04F, 0.25F},
         {0xE0832B, 0xCC6C1C, 5, 0, 0.06F, 0.12F, 0, 0, 0, 0.04F, 0.3F},
         {0x8A5A30, 0x6E4622, 4, 0, 0.1F, 0.15F, 0, 0, 0, 0.04F, 0.3F},
         {0xC9A860, 0xB8954C, 5, 0, 0.06F, 0.1F, 0, 0, 0, 0.04F, 0.3F}}}},
  };
}

}  // namespace

std::span<const FoodKind> food_kinds() {
  static const std::vector<FoodKind> kinds = make_kinds();
  return kinds;
}

const FoodKind* find_food_kind(std::string_view name) {
  const auto kinds = food_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const FoodKind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

}  // namespace traygauge
