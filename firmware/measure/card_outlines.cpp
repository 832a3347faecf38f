#include "firmware/measure/card_outlines.hpp"

#include <algorithm>
#include <bitset>
#include <cstddef>
#include <string>

#include "core/labels/label_regions.hpp"
#include "firmware/card/card_finder.hpp"

namespace traygauge {
namespace {

constexpr double kMinCardFraction = 0.8;  // of a label's pixels, on the card that it is taken for

bool lacks_card(const LoadedView& view) {
  const auto& pixels = view.labels.pixels;
  return !pixels.empty() && std::find(pixels.begin(), pixels.end(), kCardLabel) == pixels.end();
}

// Labels of food that lie on the card.
std::bitset<256> find_card_labels(const Picture& labels, ImageView<const std::uint8_t> card) {
  std::array<double, 256> all{};
  std::array<double, 256> on_card{};
  for (int y = 0; y < labels.size.height; ++y) {
    for (int x = 0; x < labels.size.width; ++x) {
      const std::uint8_t label = labels.gray().at(x, y);
      ++all.at(label);
      if (card.at(x, y) == kCardLabel) ++on_card.at(label);
    }
  }
  std::bitset<256> found;
  for (std::size_t label = kFirstItemLabel; label <= kLastItemLabel; ++label)
    found.set(label, on_card.at(label) > kMinCardFraction * all.at(label));
  return found;
}

// What stands before the card, such as a dish, keeps its label.
void outline_card(ImageView<const std::uint8_t> card, const std::bitset<256>& card_labels, Picture& labels) {
  std::size_t i = 0;
  for (int y = 0; y < labels.size.height; ++y) {
    for (int x = 0; x < labels.size.width; ++x, ++i) {
      std::uint8_t& label = labels.pixels[i];
      if (card_labels.test(label)) label = kBackgroundLabel;
      if (label == kBackgroundLabel && card.at(x, y) == kCardLabel) label = kCardLabel;
    }
  }
}

std::string describe_outline(const InputFile& labels, const std::bitset<256>& card_labels) {
  std::string text = printable(labels.path.string()) + ": no card (255) is outlined";
  for (std::size_t label = 0; label < card_labels.size(); ++label) {
    if (card_labels.test(label)) text += ", but label " + std::to_string(label) + " lies on it";
  }
  return text + "; the card was found in the picture.";
}

}  // namespace

void outline_missing_cards(const PairSetup& setup, const std::array<const ViewDescription*, 2>& descriptions,
                           std::array<LoadedView, 2>& views, std::vector<ReportedWarning>& warnings) {
  if (!lacks_card(views[0]) && !lacks_card(views[1])) return;
  TraySetup tray;
  describe_tray(setup, tray);
  CardFinder finder(tray.limits.max_frame_width, tray.limits.max_frame_height);
  if (!finder.learn(tray.card).ok()) return;
  for (std::size_t i = 0; i < 2; ++i) {
    CardAlignment alignment;
    if (!lacks_card(views[i])) continue;
    if (!finder.find(views[i].picture.frame(), setup.lenses[i], alignment).ok()) continue;
    const std::bitset<256> card_labels = find_card_labels(views[i].labels, finder.outline());
    outline_card(finder.outline(), card_labels, views[i].labels);
    warnings.push_back({"card_outline_found", describe_outline(*descriptions[i]->labels, card_labels)});
  }
}

}  // namespace traygauge
