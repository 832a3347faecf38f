#include "firmware/network/food_network.hpp"

#include <cstdlib>
#include <string>

#include "core/segmentation/picture_reading.hpp"
#include "firmware/config/config_folder.hpp"
#include "firmware/network/loaded_network.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

std::filesystem::path network_file() {
  const char* named = std::getenv("TRAYGAUGE_CONFIG");
  return find_network_file(named == nullptr ? "" : named);
}

class FoodNetwork {
 public:
  FoodNetwork() : loaded_(network_file()) {
    if (reads_food(loaded_.network())) return;
    throw InputError({network_file(), ""}, "a network that tells food, and which of it is alike",
                     "one for something else", "take the file of the release");
  }
  const Network& network() const { return loaded_.network(); }

 private:
  LoadedNetwork loaded_;
};

}  // namespace

const Network& food_network() {
  static const FoodNetwork food;
  return food.network();
}

}  // namespace traygauge
