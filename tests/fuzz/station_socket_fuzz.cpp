// What a hub says to its station while that waits for an answer: messages, each a byte for its kind and its
// text up to a zero byte. Kind 255 sends what follows as it is. A document counts as kept by the hub only
// after an answer about it.
#include <sys/socket.h>

#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "firmware/handover/hub_link.hpp"
#include "firmware/handover/next_tray.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

constexpr std::string_view kId = "kitchen-1";

class FuzzedStation {
 public:
  void hear(std::string_view said) {
    HubLink link({folder_.path() / "hub", "kitchen", "1.0", kWait, Milliseconds::zero()});
    link.attend();
    demand(link.is_connected(), "the station connects");
    Expected<LocalConnection> hub = listener_.accept();
    demand(hub.ok() && hub->is_open(), "a connection of the station");
    const bool names_document = said.find(kId) != std::string_view::npos;
    say(*hub, said);
    // After what was said comes the end, so that the station does not wait.
    ::shutdown(hub->descriptor(), SHUT_WR);
    const HubReply reply = link.deliver(kId, "{}");
    demand(!reply.is_kept_there() || names_document || said.find('\\') != std::string_view::npos,
           "an answer about the document");
    if (const std::optional<std::string> told = link.take_next_tray())
      std::ignore = read_told_tray(*told, {});
  }

 private:
  static constexpr Milliseconds kWait{1000};

  LocalListener listen() const {
    Expected<LocalListener> listener = LocalListener::open(folder_.path() / "hub");
    demand(listener.ok(), "a socket");
    return std::move(*listener);
  }
  static void say(LocalConnection& hub, std::string_view said) {
    while (!said.empty()) {
      const std::size_t kind = take_byte(said);
      if (kind == 255) {
        std::ignore = hub.send_all(said, Milliseconds::zero());
        return;
      }
      const std::string text(take_until(said, '\0'));
      std::ignore =
          hub.send_all(encode({static_cast<MessageType>(kind % 9), text, {}}), Milliseconds::zero());
    }
  }

  TemporaryFolder folder_;
  LocalListener listener_ = listen();
};

}  // namespace
}  // namespace traygauge

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static traygauge::FuzzedStation station;
  station.hear(traygauge::text_of_input(data, size));
  return 0;
}
