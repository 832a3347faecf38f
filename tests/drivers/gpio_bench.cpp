#include "tests/drivers/gpio_bench.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <fstream>
#include <map>
#include <mutex>

namespace traygauge {
namespace {

class ModelBench final : public GpioBench {
 public:
  std::unique_ptr<GpioLine> make_line(const std::string& name) override;
  void set_input(const std::string& name, bool active) override;
  bool output(const std::string& name) override {
    const std::lock_guard lock(mutex_);
    return lines_[name].is_active;
  }

 private:
  friend class ModelLine;
  struct State {
    bool is_taken = false;
    bool has_edges = false;
    bool is_active = false;
    std::deque<GpioEdge> edges;
  };
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, State> lines_;
};

class ModelLine final : public GpioLine {
 public:
  ModelLine(ModelBench& bench, std::string name) : bench_(bench), name_(std::move(name)) {}
  ~ModelLine() override { ModelLine::close(); }

  DeviceStatus open_input() override { return open(false); }
  DeviceStatus open_edges() override { return open(true); }
  DeviceStatus open_output(bool active) override {
    const DeviceStatus status = open(false);
    return status.ok() ? write(active) : status;
  }
  void close() override {
    const std::lock_guard lock(bench_.mutex_);
    if (!is_open_) return;
    is_open_ = false;
    state().is_taken = state().has_edges = false;
    state().edges.clear();
  }
  DeviceStatus read(bool& is_active) override {
    const std::lock_guard lock(bench_.mutex_);
    is_active = state().is_active;
    return is_open_ ? DeviceCode::ok : DeviceCode::io_error;
  }
  DeviceStatus write(bool active) override {
    const std::lock_guard lock(bench_.mutex_);
    state().is_active = active;
    return is_open_ ? DeviceCode::ok : DeviceCode::io_error;
  }
  DeviceStatus wait_for_edge(Nanoseconds timeout, GpioEdge& edge) override {
    std::unique_lock lock(bench_.mutex_);
    const auto has_edge = [this] { return !state().edges.empty(); };
    if (!bench_.changed_.wait_for(lock, timeout, has_edge)) return DeviceCode::timed_out;
    edge = state().edges.front();
    state().edges.pop_front();
    return DeviceCode::ok;
  }
  std::string problem() const override { return "line " + name_; }

 private:
  DeviceStatus open(bool has_edges) {
    const std::lock_guard lock(bench_.mutex_);
    if (state().is_taken) return DeviceCode::in_use;
    state().is_taken = is_open_ = true;
    state().has_edges = has_edges;
    return DeviceCode::ok;
  }
  ModelBench::State& state() { return bench_.lines_[name_]; }

  ModelBench& bench_;
  std::string name_;
  bool is_open_ = false;
};

std::unique_ptr<GpioLine> ModelBench::make_line(const std::string& name) {
  return std::make_unique<ModelLine>(*this, name);
}

void ModelBench::set_input(const std::string& name, bool active) {
  const std::lock_guard lock(mutex_);
  State& state = lines_[name];
  if (state.has_edges && state.is_active != active) state.edges.push_back({SystemClock().now(), active});
  state.is_active = active;
  changed_.notify_all();
}

class GpioSimBench final : public GpioBench {
 public:
  GpioSimBench(std::string folder, std::vector<std::string> names)
      : folder_(std::move(folder)), names_(std::move(names)) {}

  std::unique_ptr<GpioLine> make_line(const std::string& name) override { return make_gpio_line({name}); }
  void set_input(const std::string& name, bool active) override {
    std::ofstream(file(name, "pull")) << (active ? "pull-up" : "pull-down") << std::flush;
  }
  bool output(const std::string& name) override {
    int value = 0;
    std::ifstream(file(name, "value")) >> value;
    return value != 0;
  }

 private:
  std::string file(const std::string& name, const char* attribute) const {
    const auto offset = std::find(names_.begin(), names_.end(), name) - names_.begin();
    return folder_ + "/sim_gpio" + std::to_string(offset) + "/" + attribute;
  }
  std::string folder_;
  std::vector<std::string> names_;
};

}  // namespace

std::unique_ptr<GpioBench> make_model_bench() {
  return std::make_unique<ModelBench>();
}

std::unique_ptr<GpioBench> make_gpio_sim_bench(const std::string& chip_folder,
                                               const std::vector<std::string>& names) {
  return std::make_unique<GpioSimBench>(chip_folder, names);
}

}  // namespace traygauge
