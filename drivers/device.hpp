// What all devices have in common.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace traygauge {

// A device is used by one thread at a time; none of its calls throws.
class Device {
 public:
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  // What it is for people, e.g. "camera", with the node or folder behind it where there is one.
  std::string_view description() const { return description_; }
  // More about the last failure (a file, a key, a node); empty when the status says it all.
  std::string_view detail() const { return detail_; }

 protected:
  explicit Device(std::string description) : description_(std::move(description)) {}
  void set_detail(std::string_view detail) { detail_ = detail; }

 private:
  std::string description_;
  std::string detail_;
};

}  // namespace traygauge
