#include "firmware/web/web_connection.hpp"

#include <sys/socket.h>

#include <chrono>

namespace traygauge {

void WebConnection::resume() {
  if (!progress.is_suspended) return;
  progress.is_suspended = false;
  progress.read_at = std::chrono::steady_clock::now();
  wake();
}

void WebConnection::cut() {
  constexpr linger kDropUnsent{1, 0};
  ::setsockopt(descriptor_, SOL_SOCKET, SO_LINGER, &kDropUnsent, sizeof(kDropUnsent));
  close();
}

void WebConnection::close() {
  if (is_cut_) return;
  is_cut_ = true;
  ::shutdown(descriptor_, SHUT_RDWR);
  resume();
}

void WebConnection::enter(Phase phase) {
  const SteadyTime now = std::chrono::steady_clock::now();
  progress = {phase, now, now};
}

void WebConnection::note_end() {
  is_ended_ = true;
  close_if_ended();
}

void WebConnection::close_if_ended() {
  const bool is_answered = progress.phase == Phase::answer && !progress.is_suspended;
  if (!is_ended_ || is_cut_ || is_answered) return;
  char byte = 0;
  const bool is_all_read = ::recv(descriptor_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) <= 0;
  if (is_all_read || progress.is_suspended) close();
}

}  // namespace traygauge
