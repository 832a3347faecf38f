// Boards whose input lines a test moves: a model in this process, or the kernel's gpio-sim.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/gpio/gpio_line.hpp"

namespace traygauge {

class GpioBench {
 public:
  GpioBench() = default;
  GpioBench(const GpioBench&) = delete;
  GpioBench& operator=(const GpioBench&) = delete;
  virtual ~GpioBench() = default;

  // A line by its name, as the drivers take it. The bench outlives it.
  virtual std::unique_ptr<GpioLine> make_line(const std::string& name) = 0;
  // Any thread.
  virtual void set_input(const std::string& name, bool active) = 0;
  // What an output was last set to.
  virtual bool output(const std::string& name) = 0;
};

// Lines of any name. Everything may be called by any thread.
std::unique_ptr<GpioBench> make_model_bench();

// gpio-sim's chip in sysfs, with lines of these names from offset 0 on.
std::unique_ptr<GpioBench> make_gpio_sim_bench(const std::string& chip_folder,
                                               const std::vector<std::string>& names);

}  // namespace traygauge
