// A service of systemd's while it runs: what systemd knows of it, and what its processes may do. Needs root
// in a guest.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace traygauge {

class ServiceUnit {
 public:
  explicit ServiceUnit(std::string name) : name_(std::move(name)) {}

  // As `systemctl show` says it; empty where there is none.
  std::string property(const std::string& key) const;
  // Whether its log since the boot has this text.
  bool has_logged(const std::string& text) const;

  // What a process with root's rights, but under this service's control group, mounts and network, comes to:
  // 0 or errno. -1 when the service does not run.
  int open_device(const std::string& path) const;
  int connect_here(int port) const;

 private:
  int try_inside(const std::function<int()>& attempt) const;

  std::string name_;
};

}  // namespace traygauge
