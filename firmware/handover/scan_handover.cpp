#include "firmware/handover/scan_handover.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "firmware/base/json_number.hpp"
#include "firmware/handover/scan_shape.hpp"
#include "firmware/handover/tray_picture.hpp"
#include "firmware/station/scan_printer.hpp"

namespace traygauge {
namespace {

nlohmann::json calibration_json(const std::optional<CalibrationFacts>& calibration) {
  using Json = nlohmann::json;
  if (!calibration) return {};
  const std::string& day = calibration->calibrated_on;
  return {{"grade_percent", calibration->grade_percent}, {"calibrated_on", day.empty() ? Json() : Json(day)}};
}

}  // namespace

ScanHandover::ScanHandover(ResultSink& printer, HubLink& link, KeptResults& kept, std::ostream& log,
                           ScanHandoverParams params)
    : printer_(printer), link_(link), kept_(kept), log_(log), params_(std::move(params)) {
  log_notices();
}

Delivery ScanHandover::deliver(const ScanResult& result) {
  const Delivery printed = printer_.deliver(result);
  next_tray_.use_ended(result.outcome == ScanOutcome::measured);
  if (result.outcome == ScanOutcome::cancelled) return printed;
  const Expected<ScanId> id = kept_.next_id();
  if (!id.ok()) {
    note_disk(id.failure());
    return Delivery::failed;
  }
  ScanIdentity identity{*id, pressed_at_, std::nullopt, board_};
  if (result.repeats_last) identity.supersedes = last_id_;
  if (result.measurement != nullptr) {
    last_id_ = *id;
    lens_problem_ = result.lens_spot ? lens_sentence(*result.lens_spot) : std::string();
  }
  const std::string document = scan_json(result, &identity);
  const std::string text = scan_id_text(*id);
  shape_ = result.measurement != nullptr ? compose_shape(*result.measurement, text) : std::string();
  picture_ = params_.pictures != PicturePolicy::hide ? compose_picture(result.picture) : std::string();
  // In the order in which they were measured: what waits goes first.
  const bool waits_already = kept_.waiting_count() > 0;
  if (!waits_already && hand_over(text, document)) return Delivery::done;
  const Delivery kept = keep(text, document);
  return kept == Delivery::kept && waits_already && hand_over_kept() ? Delivery::done : kept;
}

Delivery ScanHandover::keep(const std::string& id, const std::string& document) {
  const Expected<void> kept = kept_.keep(id, document);
  note_disk(kept.ok() ? std::string() : kept.failure());
  return kept.ok() ? Delivery::kept : Delivery::failed;
}

// False when the hub does not have it.
bool ScanHandover::hand_over(const std::string& id, const std::string& document) {
  const HubReply reply = link_.deliver(id, document);
  was_refused_ = !reply.is_kept_there();
  if (was_refused_) asked_at_ = SteadyClock::now();
  note_hub(reply);
  if (reply.answer == HubAnswer::set_aside)
    log_ << "The hub has set scan " << id << " aside: " << reply.text << std::endl;
  return !was_refused_;
}

// False when something still waits.
bool ScanHandover::hand_over_kept() {
  const auto end = SteadyClock::now() + params_.longest_attention;
  while (kept_.waiting_count() > 0) {
    if (!queue_stands_since_) queue_stands_since_ = SteadyClock::now();
    if (was_refused_ && SteadyClock::now() - asked_at_ < params_.retry_after) return false;
    const Expected<std::optional<KeptResult>> oldest = kept_.oldest();
    log_notices();
    if (!oldest.ok()) {
      note_disk(oldest.failure());
      return false;
    }
    if (!*oldest) return true;
    if (!hand_over((*oldest)->id, (*oldest)->document)) return false;
    if (const Expected<void> removed = kept_.remove_oldest(**oldest); !removed.ok()) {
      note_disk(removed.failure());
      return false;
    }
    queue_stands_since_.reset();
    if (SteadyClock::now() > end) return kept_.waiting_count() == 0;
  }
  return true;
}

bool ScanHandover::has_room() {
  const bool was_full = std::exchange(is_full_, !kept_.has_room());
  if (is_full_) {
    note_disk("no room for a further result: " + std::to_string(kept_.waiting_count()) +
              " wait for the hub, and nothing is measured until it takes them; start the hub, or look at its "
              "disk");
  } else if (was_full) {
    note_disk({});
  }
  return !is_full_;
}

void ScanHandover::attend() {
  link_.attend();
  hear_next_tray();
  hand_over_kept();
  tell_appearance();
  look_at_board();
  if (link_.take_is_new() || SteadyClock::now() - told_at_ >= params_.heartbeat) tell_state();
}

void ScanHandover::report_state(std::string_view state) {
  if (state == "taking_first_view") pressed_at_ = read_wall_clock();
  state_ = state;
  tell_state();
}

void ScanHandover::report_fault(const DeviceFailure& failure) {
  printer_.report_fault(failure);
  faults_.insert_or_assign(std::string(failure.device),
                           Fault{name(failure.status.code()), failure_text(failure)});
  tell_state();
}

void ScanHandover::report_restart() {
  printer_.report_restart();
}

void ScanHandover::report_recovery(std::string_view what) {
  printer_.report_recovery(what);
  if (const auto found = faults_.find(what); found != faults_.end()) {
    faults_.erase(found);
  } else {
    faults_.clear();
  }
  tell_state();
}

void ScanHandover::hear_next_tray() {
  const std::optional<std::string> text = link_.take_next_tray();
  if (!text) return;
  const Expected<ToldTray> told = read_told_tray(*text, params_.facts.dish_styles);
  if (told.ok()) {
    next_tray_.tell(*told, SteadyClock::now());
  } else {
    log_ << "What the hub told of the next tray is of no use: " << told.failure() << std::endl;
  }
  tell_state();
}

// Only for looking at: who presses the button does not wait for it, and none is kept for a hub that is away.
void ScanHandover::tell_appearance() {
  using Json = nlohmann::json;
  if (!shape_.empty())
    link_.tell({MessageType::shape, Json{{"id", scan_id_text(*last_id_)}}.dump(), std::exchange(shape_, {})},
               params_.longest_shape);
  if (picture_.empty()) return;
  const Json text = {{"id", scan_id_text(*last_id_)}, {"keep", params_.pictures == PicturePolicy::keep}};
  link_.tell({MessageType::picture, text.dump(), std::exchange(picture_, {})}, params_.longest_shape);
}

// Between scans alone: a sensor may take some milliseconds.
void ScanHandover::look_at_board() {
  const auto now = SteadyClock::now();
  if (board_looked_at_ && now - *board_looked_at_ < params_.board_looked_at_every) return;
  board_looked_at_ = now;
  board_ = read_board_state(params_.board_classes);
}

// In seconds, since something waits and none of it was taken.
double ScanHandover::queue_stands_s() const {
  if (!queue_stands_since_) return 0.0;
  return std::chrono::duration<double>(SteadyClock::now() - *queue_stands_since_).count();
}

void ScanHandover::tell_state() {
  using Json = nlohmann::json;
  Json faults = Json::array();
  for (const auto& [device, fault] : faults_)
    faults.push_back({{"device", device}, {"status", fault.status}, {"message", fault.message}});
  const std::optional<ToldTray> next = next_tray_.at(SteadyClock::now());
  const Json json = {
      {"state", state_},
      {"configuration",
       params_.facts.configuration_problem.empty() ? Json() : Json(params_.facts.configuration_problem)},
      {"dishes", params_.facts.dish_styles},
      {"next_tray", next ? Json::parse(told_tray_json(*next)) : Json()},
      {"waiting_results", kept_.waiting_count()},
      {"queue_stands_s", queue_stands_s()},
      {"disk", disk_problem_.empty() ? Json() : Json(disk_problem_)},
      {"devices", params_.facts.devices},
      {"lens", lens_problem_.empty() ? Json() : Json(lens_problem_)},
      {"faults", faults},
      {"temperature_c", value_or_null<Json>(board_.temperature_c)},
      {"under_voltage", value_or_null<Json>(board_.under_voltage)},
      {"calibration", calibration_json(params_.facts.calibration)}};
  link_.tell({MessageType::state, json.dump(-1, ' ', false, Json::error_handler_t::replace), {}});
  told_at_ = SteadyClock::now();
}

void ScanHandover::log_notices() {
  for (const std::string& notice : kept_.take_notices()) log_ << notice << std::endl;
}

// A hub that is away is told once, and once that it is back.
void ScanHandover::note_hub(const HubReply& reply) {
  if (reply.is_kept_there() && !hub_problem_.empty()) log_ << "The hub takes results again." << std::endl;
  if (!reply.is_kept_there() && hub_problem_.empty())
    log_ << "The hub does not take results, which wait on this disk: " << reply.text << std::endl;
  hub_problem_ = reply.is_kept_there() ? std::string() : reply.text;
}

void ScanHandover::note_disk(const std::string& problem) {
  if (problem == disk_problem_) return;
  if (problem.empty()) {
    log_ << "Results can be kept again." << std::endl;
  } else if (disk_problem_.empty()) {
    log_ << problem << std::endl;
  }
  disk_problem_ = problem;
}

}  // namespace traygauge
