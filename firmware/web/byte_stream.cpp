#include "firmware/web/byte_stream.hpp"

#include <algorithm>
#include <utility>

namespace traygauge {
namespace {

class PieceStream final : public ByteStream {
 public:
  explicit PieceStream(NextPiece next) : next_(std::move(next)) {}

  Piece read(std::span<char> into) override {
    if (at_ == piece_.size()) {
      Expected<std::string> piece = next_();
      if (!piece.ok()) return {State::broken, 0};
      if (piece->empty()) return {State::end, 0};
      piece_ = std::move(*piece);
      at_ = 0;
    }
    const std::size_t bytes = std::min(into.size(), piece_.size() - at_);
    std::copy_n(piece_.data() + at_, bytes, into.data());
    at_ += bytes;
    return {State::data, bytes};
  }

 private:
  NextPiece next_;
  std::string piece_;
  std::size_t at_ = 0;
};

}  // namespace

std::unique_ptr<ByteStream> make_piece_stream(NextPiece next) {
  return std::make_unique<PieceStream>(std::move(next));
}

}  // namespace traygauge
