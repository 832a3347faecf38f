// The body of an answer that is made while it is sent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "firmware/base/expected.hpp"

namespace traygauge {

// What a stream may ask of the connection that sends it.
class StreamControl {
 public:
  StreamControl() = default;
  StreamControl(const StreamControl&) = delete;
  StreamControl& operator=(const StreamControl&) = delete;
  virtual ~StreamControl() = default;

  // There is something to read again, or the end.
  virtual void resume() = 0;
  // Closes the connection at once, whatever waits to be sent.
  virtual void cut() = 0;
};

class ByteStream {
 public:
  enum class State : std::uint8_t {
    data,     // `bytes` were written
    waiting,  // nothing now; the stream calls resume() when there is
    end,      // the body is complete
    broken,   // the body cannot be completed: the connection is closed, so that nobody takes it for whole
  };
  struct Piece {
    State state = State::end;
    std::size_t bytes = 0;
  };

  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;
  virtual ~ByteStream() = default;

  // Writes the next bytes. Never blocks.
  virtual Piece read(std::span<char> into) = 0;
  // It goes on as long as the client wants, so that no least rate is asked of it.
  virtual bool is_live() const { return false; }

  // `control` outlives the stream.
  void attach(StreamControl& control) { control_ = &control; }

 protected:
  ByteStream() = default;
  StreamControl* control() const { return control_; }

 private:
  StreamControl* control_ = nullptr;
};

// The next piece of a long answer; an empty one ends it, a failure breaks it off. Pieces of some kilobytes:
// the hub does nothing else while one is made.
using NextPiece = std::function<Expected<std::string>()>;
std::unique_ptr<ByteStream> make_piece_stream(NextPiece next);

}  // namespace traygauge
