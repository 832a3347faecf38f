// Files that are whole, damaged, foreign, newer, or state what cannot be.
#include "core/network/network_file.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

#include "core/base/little_endian.hpp"
#include "core/network/network_runner.hpp"
#include "tests/support/network_composer.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

NetworkFileStatus status_of(const std::vector<std::byte>& file) {
  Network network;
  return parse_network(file, network);
}

ComposedNetwork small_network() {
  ComposedNetwork network;
  network.width = 33;
  network.height = 18;
  network.provenance = "seed 1\n10 pictures";
  network.layers.push_back({3, 2, true, NetworkRole::none, {{0}}, 5});
  network.layers.push_back({3, 2, true, NetworkRole::none, {{1}}, 6});
  network.layers.push_back({3, 1, true, NetworkRole::none, {{2, Enlargement::bilinear}, {1}}, 4});
  network.layers.push_back({1, 1, false, NetworkRole::border, {{3}}, 1, 0.5F});
  network.layers.push_back({1, 1, false, NetworkRole::embedding, {{3}}, 8, 0.25F});
  network.layers.push_back({1, 1, false, NetworkRole::classes, {{3}}, 2, 0.125F});
  draw_numbers(1, network);
  network.vector = {1, 2, 3};
  return network;
}

TEST(NetworkFile, SaysWhatItHolds) {
  const std::vector<std::byte> file = compose_network(small_network());
  Network network;
  ASSERT_EQ(parse_network(file, network), NetworkFileStatus::ok);
  EXPECT_EQ(network.width, 33);
  EXPECT_EQ(network.height, 18);
  EXPECT_EQ(network.layer_count, 6U);
  ASSERT_EQ(network.class_count, 2U);
  EXPECT_EQ(network.classes[1], "food");
  EXPECT_EQ(network.provenance, "seed 1\n10 pictures");
  EXPECT_EQ(network.test.output_crc, 3U);
  const NetworkLayer& joined = network.layers[2];
  EXPECT_EQ(joined.input,
            (TensorShape{17, 9, 11}));  // 9 x 5 enlarged is 18 x 10: a row and a column are cut off
  EXPECT_EQ(joined.output, (TensorShape{17, 9, 4}));
  EXPECT_EQ(joined.weights.size(), 4U * 9 * 11);
  EXPECT_EQ(network.find(NetworkRole::border)->step, 0.5F);
  EXPECT_EQ(network.find(NetworkRole::classes), &network.layers[5]);
  EXPECT_EQ(network.find(NetworkRole::embedding)->output.channels, 8);
  EXPECT_EQ(network.multiply_adds(),
            17 * 9 * 5 * 27 + 9 * 5 * 6 * 45 + 17 * 9 * 4 * 99 + 17 * 9 * (1 + 8 + 2) * 4);
}

TEST(NetworkFile, IsRefusedWhereAnyByteIsAnother) {
  const std::vector<std::byte> whole = compose_network(small_network());
  std::mt19937 random(random_seed());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::vector<std::byte> file = whole;
    file[at] ^= static_cast<std::byte>(1 + random() % 255);
    const NetworkFileStatus expected =
        at < kNetworkSignature.size() ? NetworkFileStatus::foreign : NetworkFileStatus::damaged;
    ASSERT_EQ(status_of(file), expected) << "byte " << at;
  }
}

TEST(NetworkFile, IsRefusedWhereItIsCutOffOrTooLong) {
  const std::vector<std::byte> whole = compose_network(small_network());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::vector<std::byte> file(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_EQ(status_of(file),
              size < kNetworkSignature.size() ? NetworkFileStatus::foreign : NetworkFileStatus::damaged);
  }
  std::vector<std::byte> longer = whole;
  longer.push_back(std::byte{0});
  EXPECT_EQ(status_of(longer), NetworkFileStatus::damaged);
  // Also where length and checksum agree: the layers end before.
  store_little_endian(std::span(longer), kNetworkCheckedAt, static_cast<std::uint32_t>(longer.size()));
  mend_checksum(longer);
  EXPECT_EQ(status_of(longer), NetworkFileStatus::contradictory);
}

TEST(NetworkFile, OfANewerVersionIsTold) {
  ComposedNetwork network = small_network();
  network.version = kNetworkFileVersion + 1;
  EXPECT_EQ(status_of(compose_network(network)), NetworkFileStatus::newer);
  network.version = 0;
  EXPECT_EQ(status_of(compose_network(network)), NetworkFileStatus::contradictory);
}

struct Contradiction {
  const char* what;
  std::function<void(ComposedNetwork&)> make;
  NetworkFileStatus expected = NetworkFileStatus::contradictory;
};

TEST(NetworkFile, IsRefusedWhereItStatesWhatCannotBe) {
  using Made = ComposedNetwork;
  const std::vector<Contradiction> contradictions = {
      {"a side of 15", [](Made& n) { n.height = 15; }},
      {"a side of 1025", [](Made& n) { n.width = 1025; }, NetworkFileStatus::too_large},
      {"33 classes", [](Made& n) { n.classes.resize(33, "x"); }, NetworkFileStatus::too_large},
      {"one class", [](Made& n) { n.classes.resize(1); }},
      {"no layers", [](Made& n) { n.layers.clear(); }},
      {"33 layers", [](Made& n) { n.layers.resize(33, n.layers[5]); }, NetworkFileStatus::too_large},
      {"a class without a name", [](Made& n) { n.classes[0].clear(); }},
      {"a name that fills its field", [](Made& n) { n.classes[0].assign(24, 'x'); }},
      {"a name that goes on behind a zero", [](Made& n) { n.classes[0] = std::string("a\0b", 3); }},
      {"a name with a control character", [](Made& n) { n.classes[0] = "\x1b[31m"; }},
      {"text with a control character", [](Made& n) { n.provenance.assign(1, '\x1b'); }},
      {"a kernel of 2", [](Made& n) { n.layers[0].kernel = 2; }},
      {"a stride of 0", [](Made& n) { n.layers[0].stride = 0; }},
      {"a stride of 3", [](Made& n) { n.layers[0].stride = 3; }},
      {"a role of 4", [](Made& n) { n.layers[0].role = static_cast<NetworkRole>(4); }},
      {"no source", [](Made& n) { n.layers[0].sources.clear(); }},
      {"its own output as source", [](Made& n) { n.layers[0].sources = {{1}}; }},
      {"its own output as source, of no channels",
       [](Made& n) {
         n.layers[3].sources = {{4}};
         n.layers[3].weights.clear();
       }},
      {"a source that no layer makes", [](Made& n) { n.layers[5].sources = {{6}}; }},
      {"a tensor of 40000", [](Made& n) { n.layers[1].sources = {{40000}}; }},
      {"an enlargement of 3",
       [](Made& n) { n.layers[2].sources[0].enlargement = static_cast<Enlargement>(3); }},
      {"sources of other sizes", [](Made& n) { n.layers[2].sources[0].enlargement = Enlargement::none; }},
      {"a source that exceeds the other by two",
       [](Made& n) {
         n.layers.resize(2);  // 17 x 9, 9 x 5
         const auto add = [&](std::vector<ComposedSource> sources, int channels) {
           n.layers.emplace_back();
           n.layers.back().sources = std::move(sources);
           n.layers.back().channels = channels;
         };
         add({{2, Enlargement::nearest}}, 1);       // 18 x 10
         add({{1, Enlargement::nearest}}, 1);       // 34 x 18
         add({{3, Enlargement::nearest}, {4}}, 2);  // 36 x 20 and 34 x 18
         n.layers.back().role = NetworkRole::classes;
         for (ComposedLayer& layer : n.layers) {
           layer.biases.clear();
           layer.multipliers.clear();
           layer.shifts.clear();
         }
         draw_numbers(1, n);
       }},
      {"sources that are too small", [](Made& n) { n.layers[2].sources[1] = {0}; }},
      {"no channels", [](Made& n) { n.layers[0].channels = 0; }},
      {"257 channels", [](Made& n) { n.layers[0].channels = 257; }, NetworkFileStatus::too_large},
      {"a step of 0", [](Made& n) { n.layers[0].step = 0.0F; }},
      {"a step that is no number",
       [](Made& n) { n.layers[0].step = std::numeric_limits<float>::quiet_NaN(); }},
      {"a bias beyond 2^30", [](Made& n) { n.layers[0].biases[4] = (1 << 30) + 1; }},
      {"a multiplier of 0", [](Made& n) { n.layers[0].multipliers[4] = 0; }},
      {"a negative multiplier", [](Made& n) { n.layers[0].multipliers[0] = -1; }},
      {"a shift of 0", [](Made& n) { n.layers[0].shifts[0] = 0; }},
      {"a shift of 63", [](Made& n) { n.layers[0].shifts[4] = 63; }},
      {"one weight too few", [](Made& n) { n.layers[5].weights.pop_back(); }},
      {"one weight too many", [](Made& n) { n.layers[5].weights.push_back(0); }},
      {"two outputs of classes", [](Made& n) { n.layers[4].role = NetworkRole::classes; }},
      {"no output of classes", [](Made& n) { n.layers[5].role = NetworkRole::none; }},
      {"more classes than channels", [](Made& n) { n.classes.push_back("third"); }},
      {"a border of eight channels",
       [](Made& n) {
         n.layers[4].role = NetworkRole::border;
         n.layers[3].role = NetworkRole::none;
       }},
      {"a layer that nobody reads", [](Made& n) { n.layers[3].role = NetworkRole::none; }},
      {"a thousand million multiply-adds",
       [](Made& n) {
         n = Made();
         n.width = n.height = 1000;
         n.layers.push_back({3, 1, true, NetworkRole::none, {{0}}, 40});
         n.layers.push_back({1, 1, false, NetworkRole::classes, {{1}}, 2});
         draw_numbers(1, n);
       },
       NetworkFileStatus::too_large},
  };
  for (const Contradiction& contradiction : contradictions) {
    ComposedNetwork network = small_network();
    contradiction.make(network);
    EXPECT_EQ(status_of(compose_network(network)), contradiction.expected) << contradiction.what;
  }
}

// What is 0 in a file of this version stays free for others.
TEST(NetworkFile, IsRefusedWhereABlankIsFilled) {
  const ComposedNetwork network = small_network();
  const std::vector<std::byte> whole = compose_network(network);
  const std::size_t layer =
      kNetworkHeaderBytes + kNetworkNameBytes * network.classes.size() + network.provenance.size();
  for (const std::size_t blank : {6U, 7U, 10U, 11U, 14U, 15U}) {
    std::vector<std::byte> file = whole;
    ASSERT_EQ(file[layer + blank], std::byte{0});
    file[layer + blank] = std::byte{1};
    mend_checksum(file);
    EXPECT_EQ(status_of(file), NetworkFileStatus::contradictory) << blank;
  }
}

// Bytes by chance behind a checksum that is right: a status, or a network that fits into the memory that it
// asks for. Sanitizers see what is read outside of the file.
TEST(NetworkFile, WithTheRightChecksumMayHoldAnything) {
  const std::vector<std::byte> whole = compose_network(small_network());
  std::mt19937 random(random_seed());
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::byte> file = whole;
    // Above all where sizes and layers are stated.
    for (int change = 0; change < 1 + i % 4; ++change) {
      const std::size_t at = kNetworkVersionAt + random() % (file.size() - kNetworkVersionAt);
      file[at] = static_cast<std::byte>(random() % (i % 2 == 0 ? 5 : 256));
    }
    mend_checksum(file);
    Network network;
    if (parse_network(file, network) != NetworkFileStatus::ok) continue;
    ++accepted;
    const std::size_t bytes = required_bytes(network);
    if (bytes > kMaxNetworkBytes || network.multiply_adds() > 1'000'000) continue;
    std::vector<std::byte> block(bytes + kArenaAlignmentBytes);
    void* begin = block.data();
    std::size_t space = block.size();
    std::align(kArenaAlignmentBytes, bytes, begin, space);
    NetworkRunner runner(network, {static_cast<std::byte*>(begin), bytes});
    if (i % 16 == 0) runner.run();
  }
  EXPECT_GT(accepted, 1000);
}

}  // namespace
}  // namespace traygauge::test
