// Fruit on a page of markers as captures: fruit_captures BOARD CLOSED_ML COLUMN_ML SET
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/evaluation/real/fruit_captures.hpp"

int main(int argument_count, char** arguments) {
  if (argument_count != 5) {
    std::fprintf(stderr, "usage: fruit_captures BOARD CLOSED_ML COLUMN_ML SET\n");
    return 2;
  }
  try {
    const traygauge::BoardFruit fruit{std::atof(arguments[2]), std::atof(arguments[3])};
    std::printf("%zu captures\n", traygauge::write_fruit_captures(arguments[1], fruit, arguments[4]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fruit_captures: %s\n", error.what());
    return 2;
  }
  return 0;
}
