#include "drivers/gpio/gpio_trigger.hpp"

#include <algorithm>
#include <utility>

namespace traygauge {
namespace {

// Between two looks at whether the button is stuck.
constexpr Nanoseconds kLongestWait = std::chrono::milliseconds(200);

}  // namespace

GpioTrigger::GpioTrigger(std::unique_ptr<GpioLine> line, Clock& clock, const GpioTriggerParams& params)
    : Trigger("button " + params.line.line), line_(std::move(line)), clock_(clock), params_(params) {}

DeviceStatus GpioTrigger::do_start() {
  set_detail({});
  presses_.clear();
  differs_since_.reset();
  begun_at_.reset();
  sequence_ = 0;
  DeviceStatus status = line_->open_edges();
  if (!status.ok()) set_detail(line_->problem());
  if (!status.ok()) return status;
  status = line_->read(is_active_);
  if (status.ok() && is_active_) {
    status = DeviceCode::stuck;
    set_detail("if nobody presses it, active_low or bias of [button] is wrong");
  }
  if (!status.ok()) line_->close();
  last_edge_at_ = clock_.now() - params_.debounce;
  return status;
}

// Edges may be lost when many come at once: two to active in a row belong to one press. And one that opens an
// open contact was preceded by one that closed it: the kernel reads a bouncing line a little late.
void GpioTrigger::take(const GpioEdge& edge) {
  const bool was_open = !is_active_ && edge.at - last_edge_at_ >= params_.debounce;
  confirm_press(edge.at);
  if (was_open) begun_at_ = edge.at;
  is_active_ = edge.to_active;
  last_edge_at_ = edge.at;
  differs_since_.reset();
}

void GpioTrigger::confirm_press(Instant now) {
  if (!begun_at_ || !is_active_ || now - last_edge_at_ < params_.least_closed) return;
  presses_.push_back(*begun_at_);
  begun_at_.reset();
}

Nanoseconds GpioTrigger::until_confirmed() const {
  if (!begun_at_ || !is_active_) return kLongestWait;
  return std::max(last_edge_at_ + params_.least_closed - clock_.now(), Nanoseconds::zero());
}

DeviceStatus GpioTrigger::take_waiting_edges() {
  while (true) {
    GpioEdge edge;
    const DeviceStatus status = line_->wait_for_edge(Nanoseconds::zero(), edge);
    if (status.code() == DeviceCode::timed_out) break;
    if (!status.ok()) return status;
    take(edge);
  }
  // Where the last edge was lost, the line itself tells, but only after a while: the line changes before its
  // edge can be read, and a press whose edge finds the button pressed would not count.
  bool is_active = is_active_;
  const DeviceStatus status = line_->read(is_active);
  const Instant now = clock_.now();
  confirm_press(now);
  if (!status.ok() || is_active == is_active_) {
    differs_since_.reset();
  } else if (!differs_since_) {
    differs_since_ = now;
  } else if (now - *differs_since_ >= params_.debounce && now - last_edge_at_ >= params_.debounce) {
    is_active_ = is_active;
    last_edge_at_ = now;
    differs_since_.reset();
  }
  return status;
}

bool GpioTrigger::is_stuck() const {
  return is_active_ && clock_.now() - last_edge_at_ >= params_.stuck_after;
}

DeviceStatus GpioTrigger::do_wait_for_press(Nanoseconds timeout, Press& press) {
  const Instant deadline = clock_.now() + timeout;
  while (true) {
    if (const DeviceStatus status = take_waiting_edges(); !status.ok()) return status;
    if (!presses_.empty()) {
      press = {presses_.front(), ++sequence_};
      presses_.pop_front();
      return DeviceCode::ok;
    }
    if (is_stuck()) return DeviceCode::stuck;
    const Nanoseconds left = deadline - clock_.now();
    if (left <= Nanoseconds::zero()) return DeviceCode::timed_out;
    GpioEdge edge;
    const Nanoseconds wait = std::min({left, kLongestWait, until_confirmed()});
    const DeviceStatus status = line_->wait_for_edge(wait, edge);
    if (status.ok()) take(edge);
    if (!status.ok() && status.code() != DeviceCode::timed_out) return status;
  }
}

DeviceStatus GpioTrigger::do_wait_for_release(Nanoseconds timeout) {
  const Instant deadline = clock_.now() + timeout;
  while (true) {
    if (const DeviceStatus status = take_waiting_edges(); !status.ok()) return status;
    const Nanoseconds unsettled = last_edge_at_ + params_.debounce - clock_.now();
    if (!is_active_ && unsettled <= Nanoseconds::zero()) return DeviceCode::ok;
    const Nanoseconds left = deadline - clock_.now();
    if (left <= Nanoseconds::zero()) return DeviceCode::timed_out;
    GpioEdge edge;
    const Nanoseconds wait = is_active_ ? std::min(left, kLongestWait) : std::min(left, unsettled);
    const DeviceStatus status = line_->wait_for_edge(wait, edge);
    if (status.ok()) take(edge);
    if (!status.ok() && status.code() != DeviceCode::timed_out) return status;
  }
}

int GpioTrigger::do_pending() {
  static_cast<void>(take_waiting_edges());  // what fails is told by the next wait
  return static_cast<int>(presses_.size());
}

void GpioTrigger::do_discard_pending() {
  static_cast<void>(take_waiting_edges());
  presses_.clear();
  begun_at_.reset();
}

}  // namespace traygauge
