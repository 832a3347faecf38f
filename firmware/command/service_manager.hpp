// What systemd wants to hear of a service (sd_notify(3)): that it runs, and again and again that it gets on.
#pragma once

#include <string>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge {

// Told where NOTIFY_SOCKET says; without it nothing happens. A message that is not taken is lost: the
// watchdog then restarts the service, which is what it is for.
class ServiceManager {
 public:
  ServiceManager();

  // The first call says that the service runs. Call it after each piece of work that ended, never from a
  // timer: a service that hangs has to look like one.
  void note_progress();
  void note_stopping();

 private:
  void send(const char* text) const;

  std::string path_;  // empty: nobody listens
  FileDescriptor socket_;
  bool is_ready_ = false;
};

}  // namespace traygauge
