#include "firmware/verify/verify_plan.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "firmware/base/text.hpp"
#include "firmware/base/toml_text.hpp"
#include "simulator/bodies/proof_body.hpp"
#include "simulator/capture/toml_file.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxPlanBytes = std::size_t{1} << 18U;
constexpr std::size_t kMaxBodies = 50;
constexpr std::size_t kMaxPlaces = 20;
constexpr std::size_t kMaxAngles = 36;
constexpr std::size_t kMaxNameLength = 24;
constexpr int kMaxRepeats = 1000;
constexpr double kMaxOffMm = 3.0;  // of a measured length from the drawn one; more is a typing mistake

void require_keys(const JsonNode& node, std::initializer_list<std::string_view> keys) {
  expect_keys(node, std::span<const std::string_view>(keys.begin(), keys.size()));
}

// Part of the name of a folder.
std::string read_name(const JsonNode& node) {
  std::string name = node.text();
  const bool is_plain = std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (!is_plain || name.size() > kMaxNameLength)
    node.fail("1 to 24 of a-z, A-Z, 0-9 and _", "choose another name");
  return name;
}

double read_sigma(const JsonNode& node, const char* key, double otherwise) {
  const auto found = node.find(key);
  return found ? found->number({0.0, 100.0}) : otherwise;
}

BodySize read_measured(const JsonNode& node, const ProofBody& proof) {
  const std::vector<double> lengths = node.numbers(3, {1.0, 1000.0});
  BodySize size_mm{};
  for (std::size_t i = 0; i < size_mm.size(); ++i) {
    if (std::abs(lengths[i] - proof.size_mm[i]) > kMaxOffMm) {
      std::string names;
      for (const std::string_view name : size_names(proof.kind))
        names += (names.empty() ? "" : ", ") + std::string(name);
      node.fail(names + " in mm, each within 3 mm of what is drawn (" + fixed(proof.size_mm[0], 0) + ", " +
                    fixed(proof.size_mm[1], 0) + ", " + fixed(proof.size_mm[2], 0) + ")",
                "measure again; a body that is so far off was printed at another scale");
    }
    size_mm[i] = lengths[i];
  }
  return size_mm;
}

VerifyBody read_folded(const JsonNode& node) {
  require_keys(node, {"proof", "name", "measured_mm", "length_sigma_mm"});
  const JsonNode proof_node = node.member("proof");
  const ProofBody* const proof = find_proof_body(proof_node.text());
  if (proof == nullptr) {
    std::string list;
    for (const ProofBody& known : proof_bodies())
      list += (list.empty() ? "one of " : ", ") + std::string(known.id);
    proof_node.fail(list, "correct the value; traygauge verify bodies prints them");
  }
  VerifyBody body;
  body.proof = proof->id;
  const auto name = node.find("name");
  body.id = name ? read_name(*name) : body.proof;
  BodySize size_mm = proof->size_mm;
  double sigma_mm = kFoldedSigmaMm;
  body.origin = "folded, lengths as drawn";
  if (const auto measured = node.find("measured_mm")) {
    size_mm = read_measured(*measured, *proof);
    sigma_mm = kCaliperSigmaMm;
    body.origin = "folded, lengths by caliper";
  }
  sigma_mm = read_sigma(node, "length_sigma_mm", sigma_mm);
  if (sigma_mm == 0.0) body.origin = "rendered, exact";
  body.volume_ml = body_volume_ml(proof->kind, size_mm);
  body.volume_sigma_ml = body_volume_sigma_ml(proof->kind, size_mm, sigma_mm);
  return body;
}

VerifyBody read_body(const JsonNode& node) {
  if (node.find("proof")) return read_folded(node);
  require_keys(node, {"name", "volume_ml", "volume_sigma_ml"});
  VerifyBody body;
  body.id = read_name(node.member("name"));
  body.origin = "the tester's own";
  body.volume_ml = node.member("volume_ml").number({1.0, 10000.0});
  body.volume_sigma_ml = node.member("volume_sigma_ml").number({0.0, 0.2 * body.volume_ml});
  return body;
}

VerifyPlace read_place(const JsonNode& node) {
  require_keys(node, {"name", "shift_mm"});
  VerifyPlace place;
  place.name = read_name(node.member("name"));
  std::ranges::copy(node.member("shift_mm").numbers(2, {-500.0, 500.0}), place.shift_mm.begin());
  return place;
}

std::string angle_text(double angle_deg) {
  const std::string text = fixed(angle_deg, 1);
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

template <class Named, class Member>
void require_different(const JsonNode& node, const std::vector<Named>& list, Member member) {
  std::set<std::string> seen;
  for (const Named& entry : list) {
    if (!seen.insert(entry.*member).second)
      node.fail("names that differ", "rename one of the two called " + entry.*member);
  }
}

void add_steps(const std::vector<double>& angles_deg, VerifyPlan& plan) {
  for (std::size_t body = 0; body < plan.bodies.size(); ++body) {
    for (std::size_t place = 0; place < plan.places.size(); ++place) {
      for (const double angle_deg : angles_deg) {
        plan.steps.push_back(
            {plan.bodies[body].id + "-" + plan.places[place].name + "-" + angle_text(angle_deg), body, place,
             angle_deg, false});
      }
    }
  }
}

void add_repeats(const JsonNode& node, double angle_deg, VerifyPlan& plan) {
  require_keys(node, {"body", "count"});
  const JsonNode body_node = node.member("body");
  const auto body = std::ranges::find(plan.bodies, body_node.text(), &VerifyBody::id);
  if (body == plan.bodies.end()) body_node.fail("the name of one of the bodies", "correct the value");
  const int count = node.member("count").integer(2, kMaxRepeats);
  for (int i = 1; i <= count; ++i) {
    plan.steps.push_back({body->id + "-repeat-" + (i < 10 ? "0" : "") + std::to_string(i),
                          static_cast<std::size_t>(body - plan.bodies.begin()), 0, angle_deg, true});
  }
}

std::string number_list(std::span<const double> numbers) {
  std::string text = "[";
  for (const double number : numbers) text += (text.size() > 1 ? ", " : "") + toml_number(number);
  return text + "]";
}

}  // namespace

VerifyPlan read_verify_plan(const std::filesystem::path& file) {
  const JsonDocument document = read_toml(file, kMaxPlanBytes, "a plan of traygauge verify in TOML");
  const JsonNode root = document.root();
  require_keys(root, {"version", "name", "dish", "attempts", "angles_deg", "bodies", "places", "repeats"});
  root.member("version").integer(1, 1);
  VerifyPlan plan;
  plan.name = read_name(root.member("name"));
  plan.dish = root.member("dish").text();
  if (const auto attempts = root.find("attempts")) plan.attempts = attempts->integer(1, 20);
  for (const JsonNode& body : root.member("bodies").elements(1, kMaxBodies))
    plan.bodies.push_back(read_body(body));
  require_different(root.member("bodies"), plan.bodies, &VerifyBody::id);
  for (const JsonNode& place : root.member("places").elements(1, kMaxPlaces))
    plan.places.push_back(read_place(place));
  require_different(root.member("places"), plan.places, &VerifyPlace::name);
  std::vector<double> angles_deg;
  for (const JsonNode& angle : root.member("angles_deg").elements(1, kMaxAngles))
    angles_deg.push_back(angle.number({0.0, 359.9}));
  add_steps(angles_deg, plan);
  if (const auto repeats = root.find("repeats")) add_repeats(*repeats, angles_deg.front(), plan);
  require_different(root, plan.steps, &VerifyStep::id);
  return plan;
}

std::string compose_default_plan(const std::string& dish, double folded_sigma_mm) {
  std::string text =
      "# A plan for `traygauge verify run`: each body at each place and angle, then the repeats. Lengths in "
      "mm, angles in\n"
      "# degrees, volumes in ml. Half an hour for one person.\n"
      "version = 1\n"
      "name = \"default\"\n"
      "dish = " +
      toml_text(dish) +
      "                    # the style of the dish that the bodies stand on; its flat bottom has to hold "
      "each of them\n"
      "attempts = 3                       # of a scan that is refused\n"
      "angles_deg = [0.0, 45.0]           # of a body's length from left-right, counter-clockwise from "
      "above\n";
  for (const ProofBody& body : proof_bodies()) {
    text += "\n[[bodies]]\nproof = \"" + std::string(body.id) + "\"                     # " +
            std::string(name(body.kind)) + ", " + fixed(body_volume_ml(body.kind, body.size_mm), 1) + " ml\n";
    if (folded_sigma_mm != kFoldedSigmaMm) text += "length_sigma_mm = " + toml_number(folded_sigma_mm) + "\n";
    text += "# measured_mm = " + number_list(body.size_mm) + "  # by caliper: ";
    for (const std::string_view length : size_names(body.kind))
      text += (text.ends_with(": ") ? "" : ", ") + std::string(length);
    text += "\n";
  }
  text +=
      "\n# A body of your own, its volume by caliper or by the water that it displaces:\n"
      "# [[bodies]]\n"
      "# name = \"stone\"\n"
      "# volume_ml = 211.0\n"
      "# volume_sigma_ml = 1.5            # its standard deviation\n"
      "\n[[places]]\n"
      "name = \"middle\"\n"
      "shift_mm = [0.0, 0.0]              # of the dish from the middle of the tray: to the right, away from "
      "the front\n"
      "\n[[places]]\nname = \"left\"\nshift_mm = [-30.0, 0.0]\n"
      "\n[[places]]\nname = \"back\"\nshift_mm = [0.0, 30.0]\n"
      "\n[repeats]                          # at the first place and angle, the body lifted and laid again "
      "each time\n"
      "body = \"R180\"\n"
      "count = 10\n";
  return text;
}

}  // namespace traygauge
