// The paper's Tables I to VII and the comparisons of its text (V): what stands in each row, and which
// measurement is compared with it. The text that we have of the paper exchanges the numbers of Tables I and
// II and of VI and VII; the captions count.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/evaluation/tables/variant.hpp"

namespace traygauge::tables {

enum class PaperSet : std::uint8_t { meals, angles, plates, meals14 };
inline constexpr int kPaperSets = 4;
const char* name(PaperSet set);  // "meals-45", …

struct Row {
  std::string title;
  PaperSet set = PaperSet::meals;
  Variant variant;
  std::optional<double> paper_mape;    // %
  std::optional<double> paper_time_s;  // of a measurement
  std::optional<double> angle_deg;     // only pairs of view 0 at about this relative angle
  std::optional<double> number;        // where the row stands in a plot; else by its place in the table
  std::string dish_style;              // only captures with such a dish; empty: all
  std::string reference;               // title of the row that it is compared with; empty: none
};

struct Table {
  std::string command;  // table-1, …, text
  std::string title;
  std::string axis;  // what the rows' numbers are; empty where they have none
  std::vector<Row> rows;
};

std::vector<Table> paper_tables();

// Nothing when there is no such table.
std::optional<Table> find_table(const std::string& command);

}  // namespace traygauge::tables
