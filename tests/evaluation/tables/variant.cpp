#include "tests/evaluation/tables/variant.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "firmware/config/parameters.hpp"
#include "firmware/config/profile.hpp"
#include "simulator/capture/content_hash.hpp"

namespace traygauge::tables {
namespace {

// In the order of Method.
constexpr std::array<const char*, 7> kNames = {"ours",        "sift",         "orb",        "presac",
                                               "single_view", "sparse_views", "dense_views"};

// A picture over the box of the smallest dish in it.
constexpr double kWholePicture = 8.0;

// Memory for working pictures larger than the station's.
void make_room(paper::Configuration& configuration) {
  const paper::Configuration usual;
  const double factor = configuration.view.matching_dish_px / usual.view.matching_dish_px *
                        (configuration.view.match_dish_only ? 1.0 : kWholePicture);
  if (factor <= 1.0) return;
  const double side = std::sqrt(factor);
  const auto grown = [](int size, double by) { return static_cast<int>(std::ceil(size * by)); };
  configuration.caps.max_working_px = grown(usual.caps.max_working_px, factor);
  configuration.caps.max_working_side_px = grown(usual.caps.max_working_side_px, side);
  configuration.rectification.max_rows = grown(usual.rectification.max_rows, side);
  configuration.rectification.max_columns = grown(usual.rectification.max_columns, side);
  configuration.disparity_range.max_count = grown(usual.disparity_range.max_count, side);
}

}  // namespace

const char* name(Method method) {
  return kNames[static_cast<std::size_t>(method)];
}

ProfileParameters configure(const Variant& variant) {
  ProfileParameters parameters;
  parameters.profile = variant.profile;
  for (const std::string& setting : variant.settings) set_parameter(parameters, setting);
  make_room(parameters.paper);
  return parameters;
}

std::string describe(const Variant& variant) {
  std::ostringstream text;
  text << "method " << name(variant.method) << "\nprofile " << traygauge::name(variant.profile)
       << "\npictures " << describe(variant.pictures) << '\n';
  std::string parameters;
  for (const std::string& line : list_parameters(configure(variant))) parameters += line + "\n";
  text << "parameters " << content_hash(parameters) << '\n';
  return text.str();
}

}  // namespace traygauge::tables
