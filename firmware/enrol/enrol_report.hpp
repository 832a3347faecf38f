// What the survey of an empty dish says, for people and as a document.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/enrolment/dish_survey.hpp"
#include "simulator/capture/dish_description.hpp"

namespace traygauge {

struct EnrolReport {
  std::string capture;  // as named by the caller
  std::array<int, 2> pair{};
  std::uint64_t seed = 0;
  std::string file;      // that was written; empty when none was
  DishDescription dish;  // holds when the survey's status is ok
  const DishSurvey* survey = nullptr;
};

// The sentence of the status, and what to do about it.
std::string compose_enrol_message(const EnrolReport& report);

// One JSON document on one line; what was not measured is null.
std::string compose_enrol_document(const EnrolReport& report);

// The same for people.
std::string compose_enrol_table(const EnrolReport& report);

}  // namespace traygauge
