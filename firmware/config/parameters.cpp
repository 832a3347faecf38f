#include "firmware/config/parameters.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <type_traits>

#include "core/paper/pipeline/parameters.hpp"
#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/config/profile.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kParameterWidth = 64;

// The shortest text without an exponent that reads back as the same number.
template <class Number>
std::string shown(Number number) {
  std::array<char, 400> digits{};  // the largest double has 309
  char* last = digits.data() + digits.size();
  if constexpr (std::is_integral_v<Number>) {
    return {digits.data(), std::to_chars(digits.data(), last, number).ptr};
  } else {
    return {digits.data(), std::to_chars(digits.data(), last, number, std::chars_format::fixed).ptr};
  }
}

struct Parameter {
  std::string name;
  std::string value;
  std::string domain;                              // what it may be
  std::function<bool(const std::string&)> assign;  // false: not one of those
};

class ParameterList {
 public:
  template <class Number>
  void operator()(const char* name, Number& field, const ParameterRange& range) {
    const auto assign = [&field, range](const std::string& text) {
      double number = 0.0;
      const char* end = text.data() + text.size();
      const auto [stop, problem] = std::from_chars(text.data(), end, number);
      if (problem != std::errc() || stop != end || !range.contains(number)) return false;
      if (std::is_integral_v<Number> && number != std::floor(number)) return false;
      field = static_cast<Number>(number);
      return true;
    };
    std::string domain = range.step == 0.0 ? "" : "a multiple of " + shown(range.step) + " from ";
    domain += shown(range.low) + " to " + shown(range.high);
    if (std::is_integral_v<Number> && range.step == 0.0) domain = "a whole number from " + domain;
    parameters_.push_back({name, shown(field), domain, assign});
  }

  void operator()(const char* name, bool& field) {
    parameters_.push_back(
        {name, field ? "true" : "false", "true or false", [&field](const std::string& text) {
           if (text != "true" && text != "false") return false;
           field = text == "true";
           return true;
         }});
  }

  template <class Enum>
  void operator()(const char* name, Enum& field, const ParameterChoices& choices) {
    const auto assign = [&field, choices](const std::string& text) {
      for (std::size_t i = 0; i < choices.count(); ++i) {
        if (text != choices.names.at(i)) continue;
        field = static_cast<Enum>(i);
        return true;
      }
      return false;
    };
    std::string domain;
    for (std::size_t i = 0; i < choices.count(); ++i)
      domain += (i == 0 ? "" : " or ") + std::string(choices.names.at(i));
    parameters_.push_back({name, choices.names.at(static_cast<std::size_t>(field)), domain, assign});
  }

  const std::vector<Parameter>& items() const { return parameters_; }
  const Parameter* find(const std::string& name) const {
    for (const Parameter& parameter : parameters_) {
      if (parameter.name == name) return &parameter;
    }
    return nullptr;
  }

 private:
  std::vector<Parameter> parameters_;
};

// When pictures are refused or doubted.
void visit_tray(TraySetup& tray, ParameterList& visit) {
  using Range = ParameterRange;
  ViewGeometryParams& geometry = tray.geometry;
  visit("geometry.min_angle_deg", geometry.min_angle_deg, Range{0, 180});
  visit("geometry.max_angle_deg", geometry.max_angle_deg, Range{0, 180});
  visit("geometry.small_angle_deg", geometry.small_angle_deg, Range{0, 180});
  visit("geometry.large_angle_deg", geometry.large_angle_deg, Range{0, 180});
  visit("geometry.max_arm_deviation_deg", geometry.max_arm_deviation_deg, Range{0, 180});
  ViewCheckParams& checks = tray.view_checks;
  visit("pictures.max_blur_px", checks.max_blur_px, Range{0, 100});
  visit("pictures.underexposed_white", checks.underexposed_white, Range{0, 255});
  visit("pictures.min_visible_card", checks.min_visible_card, Range{0, 1});
  visit("pictures.max_clipped", checks.max_clipped, Range{0, 1});
  visit("pictures.max_exposure_ratio", checks.max_exposure_ratio, Range{1, 100});
  visit("pictures.max_white_balance_ratio", checks.max_white_balance_ratio, Range{1, 100});
}

TraySetup& tray_of(ProfileParameters& parameters) {
  if (parameters.profile == Profile::paper) return parameters.paper;
  return parameters.best;
}

ParameterList shared_parameters(ProfileParameters& parameters) {
  ParameterList list;
  visit_tray(tray_of(parameters), list);
  return list;
}

// When an item is doubted, and what its uncertainty follows from (tests/evaluation/fit).
ParameterList best_parameters(Configuration& configuration) {
  ParameterList list;
  list("items.min_matched_fraction", configuration.pipeline.min_matched_fraction, ParameterRange{0, 1});
  list("items.max_sigma_fraction", configuration.pipeline.max_sigma_fraction, ParameterRange{0, 100});
  UncertaintyParams& uncertainty = configuration.uncertainty;
  const ParameterRange weight{0, 1000};
  list("uncertainty.disparity_bias_px", uncertainty.disparity_bias_px, weight);
  list("uncertainty.height_mm", uncertainty.height_mm, weight);
  list("uncertainty.hidden_fraction", uncertainty.hidden_fraction, weight);
  list("uncertainty.outline_px", uncertainty.outline_px, weight);
  list("uncertainty.found_outline_mm", uncertainty.found_outline_mm, weight);
  list("uncertainty.wall_mm", uncertainty.wall_mm, weight);
  list("uncertainty.filled_fraction", uncertainty.filled_fraction, weight);
  list("uncertainty.round_fraction", uncertainty.round_fraction, weight);
  return list;
}

ParameterList paper_parameters(paper::Configuration& configuration) {
  ParameterList list;
  paper::visit_parameters(configuration, list);
  return list;
}

ParameterList parameters_of(Profile profile, ProfileParameters& parameters) {
  return profile == Profile::paper ? paper_parameters(parameters.paper) : best_parameters(parameters.best);
}

void append_lines(const std::string& title, const ParameterList& list, std::vector<std::string>& lines) {
  lines.push_back("# " + title);
  for (const Parameter& parameter : list.items()) {
    lines.push_back(pad_right(parameter.name + "=" + parameter.value, kParameterWidth) + "  (" +
                    parameter.domain + ")");
  }
}

}  // namespace

void set_parameter(ProfileParameters& parameters, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string name = assignment.substr(0, equals);
  const std::string text = equals == std::string::npos ? std::string() : assignment.substr(equals + 1);
  const Profile other = parameters.profile == Profile::best ? Profile::paper : Profile::best;
  const ParameterList shared = shared_parameters(parameters);
  const ParameterList own = parameters_of(parameters.profile, parameters);
  const Parameter* parameter = own.find(name);
  if (parameter == nullptr) parameter = shared.find(name);
  if (parameter == nullptr) {
    if (parameters_of(other, parameters).find(name) != nullptr) {
      throw UsageError("--set " + name + ": profile " + traygauge::name(parameters.profile) +
                       " does not read it; add --profile " + traygauge::name(other));
    }
    throw UsageError("--set: no parameter " + printable(name) + "; see traygauge evaluate --parameters");
  }
  if (!parameter->assign(text))
    throw UsageError("--set " + name + ": expected " + parameter->domain + ", found " + printable(text));
}

std::vector<std::string> list_parameters(const ProfileParameters& parameters) {
  ProfileParameters copy = parameters;
  std::vector<std::string> lines;
  append_lines("both profiles", shared_parameters(copy), lines);
  append_lines("profile best", parameters_of(Profile::best, copy), lines);
  append_lines("profile paper", parameters_of(Profile::paper, copy), lines);
  return lines;
}

}  // namespace traygauge
