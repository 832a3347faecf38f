// One way to measure: what a row of the paper's tables stands for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/config/profile.hpp"
#include "tests/evaluation/tables/picture_change.hpp"

namespace traygauge::tables {

enum class Method : std::uint8_t {
  ours,          // a profile with settings of its own
  sift,          // OpenCV's SIFT in the place of SURF
  orb,           // OpenCV's ORB in the place of SURF
  presac,        // preemptive RANSAC in the place of the paper's
  single_view,   // shape priors in one view, as [20]
  sparse_views,  // shape templates on triangulated SIFT points, as [23]
  dense_views,   // Harris tracks, PRESAC, dense NCC and the card's plane, as [24]
};
const char* name(Method method);

struct Variant {
  Method method = Method::ours;
  Profile profile = Profile::paper;
  std::vector<std::string> settings;  // NAME=VALUE over the profile's defaults
  PictureChange pictures{};
};

// Throws UsageError where a setting does not hold.
ProfileParameters configure(const Variant& variant);

// Everything in a variant that results depend on, as text.
std::string describe(const Variant& variant);

}  // namespace traygauge::tables
