#include <iostream>

#include "tests/evaluation/tables/tables_command.hpp"

int main(int argument_count, char** arguments) {
  return traygauge::tables::run_tables_command(argument_count, arguments, std::cout, std::cerr);
}
