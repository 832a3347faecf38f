// The few nearest neighbours of one feature, nearest first.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace traygauge::paper {

inline constexpr int kMaxNeighbours = 3;  // two that can match, and the one that the second is judged against

struct Neighbours {
  std::array<float, kMaxNeighbours> square{};  // squared distances; infinite where there is no neighbour
  std::array<std::int32_t, kMaxNeighbours> index{};

  void clear() {
    square.fill(std::numeric_limits<float>::infinity());
    index.fill(-1);
  }

  // The squared distance beyond which nothing enters the first `count` places.
  float limit(int count) const { return square[static_cast<std::size_t>(count - 1)]; }

  // Keeps the `count` nearest. Equal distances go by index, so the order of the search does not matter.
  void insert(float candidate_square, std::int32_t candidate, int count) {
    auto place = static_cast<std::size_t>(count);
    while (place > 0 && is_nearer(candidate_square, candidate, place - 1)) --place;
    if (place == static_cast<std::size_t>(count)) return;
    for (auto i = static_cast<std::size_t>(count - 1); i > place; --i) {
      square[i] = square[i - 1];
      index[i] = index[i - 1];
    }
    square[place] = candidate_square;
    index[place] = candidate;
  }

 private:
  bool is_nearer(float candidate_square, std::int32_t candidate, std::size_t place) const {
    if (candidate_square != square[place]) return candidate_square < square[place];
    return index[place] < 0 || candidate < index[place];
  }
};

}  // namespace traygauge::paper
