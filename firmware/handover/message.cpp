#include "firmware/handover/message.hpp"

#include <array>
#include <cassert>

namespace traygauge {
namespace {

// "TGM" and the version of this format; type; then two lengths, 32 bits each, lowest byte first.
constexpr std::string_view kMagic = "TGM1";
constexpr std::size_t kHeaderBytes = kMagic.size() + 1 + 2 * sizeof(std::uint32_t);

constexpr auto kNames =
    std::to_array<const char*>({"hello", "scan", "state", "shape", "picture", "stored", "set_aside",
                                "refused", "next_tray", "ask_drift", "drift"});
static_assert(kNames.size() == static_cast<std::size_t>(MessageType::drift) + 1);

void append_length(std::size_t length, std::string& out) {
  for (unsigned shift = 0; shift < 32; shift += 8) out += static_cast<char>((length >> shift) & 0xFFU);
}

std::size_t length_at(std::string_view bytes, std::size_t at) {
  std::size_t length = 0;
  for (unsigned i = 0; i < 4; ++i)
    length |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return length;
}

// What does not begin as our messages do.
std::string describe_foreign(std::string_view beginning) {
  const std::string expected = "expected a message of Traygauge's format 1, found ";
  const std::string_view without_version = kMagic.substr(0, kMagic.size() - 1);
  if (beginning.size() == kMagic.size() && beginning.starts_with(without_version) &&
      beginning.back() >= '0' && beginning.back() <= '9')
    return expected + "format " + beginning.back() + ": install station and hub of one version";
  return expected + "something else";
}

}  // namespace

const char* name(MessageType type) {
  return kNames[static_cast<std::size_t>(type)];
}

std::string encode(const Message& message) {
  assert(message.text.size() <= kMaxTextBytes && message.bytes.size() <= kMaxBodyBytes);
  std::string out;
  out.reserve(kHeaderBytes + message.text.size() + message.bytes.size());
  out += kMagic;
  out += static_cast<char>(message.type);
  append_length(message.text.size(), out);
  append_length(message.bytes.size(), out);
  return out + message.text + message.bytes;
}

Expected<std::optional<Message>> MessageReader::next() {
  const std::string_view compared = std::string_view(received_).substr(0, kMagic.size());
  if (compared != kMagic.substr(0, compared.size())) return Failure{describe_foreign(compared)};
  if (received_.size() < kHeaderBytes) return std::optional<Message>();
  const auto type = static_cast<unsigned char>(received_[kMagic.size()]);
  if (type >= kNames.size())
    return Failure{"expected one of " + std::to_string(kNames.size()) + " kinds of messages, found kind " +
                   std::to_string(type)};
  const std::size_t text_bytes = length_at(received_, kMagic.size() + 1);
  const std::size_t body_bytes = length_at(received_, kMagic.size() + 1 + sizeof(std::uint32_t));
  if (text_bytes > kMaxTextBytes || body_bytes > kMaxBodyBytes)
    return Failure{"expected at most " + std::to_string(kMaxTextBytes) + " and " +
                   std::to_string(kMaxBodyBytes) + " bytes in a message, found " +
                   std::to_string(text_bytes) + " and " + std::to_string(body_bytes)};
  const std::size_t whole = kHeaderBytes + text_bytes + body_bytes;
  if (received_.size() < whole) return std::optional<Message>();
  Message message{static_cast<MessageType>(type), received_.substr(kHeaderBytes, text_bytes),
                  received_.substr(kHeaderBytes + text_bytes, body_bytes)};
  received_.erase(0, whole);
  return std::optional(std::move(message));
}

}  // namespace traygauge
