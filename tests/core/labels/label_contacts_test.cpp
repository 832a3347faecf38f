#include "core/labels/label_contacts.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numeric>

namespace traygauge {
namespace {

using Contacts = std::array<std::uint32_t, kByteValues>;

Contacts contacts_of(const std::array<std::uint8_t, 20>& labels, std::uint8_t label) {
  Contacts contacts{};
  count_contacts({labels.data(), 5, 4}, label, contacts);
  return contacts;
}

constexpr std::array<std::uint8_t, 20> kFriedEgg = {
    2, 2, 2, 2, 1,  //
    2, 3, 3, 2, 1,  //
    2, 3, 2, 2, 1,  //
    2, 2, 2, 9, 9,
};

TEST(LabelContacts, CountsSidesOfPixels) {
  const Contacts yolk = contacts_of(kFriedEgg, 3);
  EXPECT_EQ(yolk[2], 8U);
  EXPECT_EQ(yolk[1] + yolk[9], 0U);
  const Contacts white = contacts_of(kFriedEgg, 2);
  EXPECT_EQ(white[3], 8U);
  EXPECT_EQ(white[1], 3U);
  EXPECT_EQ(white[9], 2U);
  EXPECT_EQ(white[2], 0U) << "it does not touch itself";
}

TEST(LabelContacts, OfALabelThatIsNotThereAreNone) {
  const Contacts none = contacts_of(kFriedEgg, 7);
  EXPECT_EQ(std::accumulate(none.begin(), none.end(), 0U), 0U);
}

}  // namespace
}  // namespace traygauge
