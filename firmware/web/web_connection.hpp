// One connection of a client, and the request that is on it.
#pragma once

#include <optional>
#include <string>

#include "firmware/web/acceptor.hpp"
#include "firmware/web/byte_stream.hpp"
#include "firmware/web/connection_limits.hpp"
#include "firmware/web/request_intake.hpp"

namespace traygauge {

class WebConnection : public StreamControl {
 public:
  using Phase = ConnectionProgress::Phase;

  explicit WebConnection(const AcceptedSocket& socket) : descriptor_(socket.descriptor), peer_(socket.peer) {
    enter(Phase::head);
  }

  void resume() override;
  void cut() override;  // drops what was not sent
  // Sends what the kernel holds, and no more.
  void close();
  void enter(Phase phase);
  // The client sends no more: closes, unless an answer is under way.
  void note_end();
  // The same, where note_end() came while there was still something to read.
  void close_if_ended();

  const PeerAddress& peer() const { return peer_; }
  bool is_cut() const { return is_cut_; }

  ConnectionProgress progress;
  std::string target;                   // of the request, as sent
  std::optional<RequestIntake> intake;  // once the head is complete

 protected:
  // The server looks at a suspended connection again.
  virtual void wake() = 0;

 private:
  int descriptor_ = -1;  // the server closes it once it was shut down
  PeerAddress peer_;
  bool is_ended_ = false;
  bool is_cut_ = false;
};

}  // namespace traygauge
