// Whether this processor computes what whoever wrote the file got.
#pragma once

#include <cstdint>

#include "core/network/network_runner.hpp"

namespace traygauge {

// A picture of noise over a slope, by integers alone. Byte i of it, with the state x beginning at `seed`:
// x = 1664525 x + 1013904223 mod 2^32 (Knuth's and Lewis's generator, from Numerical Recipes), and the byte
// is
// ((x >> 24) + i / 3 % 256) / 2.
void draw_test_picture(std::uint32_t seed, ImageView<std::uint8_t> picture);

struct TestVectorOutcome {
  bool has_same_picture = false;
  bool has_same_outputs = false;
};

// Runs the network once on its test picture.
TestVectorOutcome check_test_vector(const Network& network, NetworkRunner& runner);

}  // namespace traygauge
