// What a station says to its hub, after its hello: messages, each a byte for its kind, its text up to a zero
// byte, and its bytes up to the next one. Kind 255 sends what follows as it is. The hub closes the connection
// or goes on, answers each scan, never stores a scan of another station, and knows medians of what it stored.
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "firmware/api/shape_mesh.hpp"
#include "firmware/drift/drift_watch.hpp"
#include "firmware/handover/told_drift.hpp"
#include "firmware/hub/picture_shelf.hpp"
#include "firmware/hub/shape_shelf.hpp"
#include "firmware/hub/station_inbox.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

constexpr std::string_view kStation = "kitchen";

class FuzzedHub {
 public:
  void hear(std::string_view said) {
    Expected<LocalConnection> station = connect_local(socket());
    demand(station.ok(), "the hub listens");
    send(*station, encode({MessageType::hello, R"({"station":"kitchen"})", {}}));
    const bool says_another_name = said.find("station\"") != std::string_view::npos;
    while (!said.empty()) {
      const std::size_t kind = take_byte(said);
      if (kind == 255) {
        send(*station, std::string(said));
        break;
      }
      Message message;
      message.type = static_cast<MessageType>(kind % 11);
      message.text = take_until(said, '\0');
      message.bytes = take_until(said, '\0');
      send(*station, encode(message));
    }
    inbox_.attend();
    check_answers(*station);
    station->close();
    for (int i = 0; i < 2; ++i) inbox_.attend();
    if (!says_another_name)
      demand(!inbox_.stations().at(std::string(kStation)).is_connected, "nobody is there any more");
  }

 private:
  std::filesystem::path socket() const { return folder_.path() / "hub"; }
  LocalListener listen() const {
    Expected<LocalListener> listener = LocalListener::open(socket());
    demand(listener.ok(), "a socket");
    return std::move(*listener);
  }
  HubStore open() const {
    HubStoreParams params;
    params.options.file = folder_.path() / "results.db";
    Expected<HubStore> store = HubStore::open(params);
    demand(store.ok(), "a store");
    return std::move(*store);
  }
  DriftWatch watch() {
    DriftWatch watch(store_);
    demand(watch.follow({}).ok(), "a store that can be read");
    return watch;
  }
  StationListener listener() {
    StationListener told;
    told.on_stored = [this](const ScanId& id) {
      demand(id.station == kStation, "a scan of the station");
      drift_.note(id);
      for (const StationTrends& station : drift_.trends()) {
        for (const CheckTrend& trend : station.trends) {
          demand(std::isfinite(trend.last.value) && std::isfinite(trend.last.sigma),
                 "a median that is a number");
          demand(!drift_sentence(trend).empty(), "a sentence about drift");
        }
      }
    };
    told.on_shape = [this](const ScanId& id, std::string json) {
      const Expected<ReadShape> shape = read_shape(json);
      if (shape.ok()) demand(compose_shape_mesh(*shape).starts_with("ply\n"), "a mesh");
      std::ignore = shapes_.put(id, std::move(json));
    };
    told.on_picture = [this](const ScanId& id, std::string jpeg, bool) {
      std::ignore = pictures_.show(id, std::move(jpeg));
    };
    told.tell_drift = [](const std::string&) { return told_drift_json({}); };
    told.on_problem = [](const std::string& problem) { demand(!problem.empty(), "a sentence"); };
    return told;
  }
  static void check_answers(LocalConnection& station) {
    const Expected<std::string> heard = station.receive_some(Milliseconds::zero());
    if (!heard.ok()) return;
    MessageReader reader;
    reader.append(*heard);
    for (;;) {
      const Expected<std::optional<Message>> answer = reader.next();
      demand(answer.ok(), "the hub answers in messages");
      if (!*answer) break;
      demand((*answer)->type == MessageType::stored || (*answer)->type == MessageType::set_aside ||
                 (*answer)->type == MessageType::drift,
             "a scan is stored or set aside");
    }
  }
  // What is sent to a hub that has closed is lost.
  static void send(LocalConnection& station, const std::string& bytes) {
    std::ignore = station.send_all(bytes, Milliseconds::zero());
  }

  TemporaryFolder folder_;
  HubStore store_ = open();
  DriftWatch drift_ = watch();
  ShapeShelf shapes_;
  PictureShelf pictures_{{}};
  StationInbox inbox_{listen(), store_, listener()};
};

}  // namespace
}  // namespace traygauge

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace traygauge;
  // A store that has grown is slow.
  constexpr int kRunsAStore = 5000;
  static std::unique_ptr<FuzzedHub> hub;
  static int runs = 0;
  if (runs++ % kRunsAStore == 0) {
    hub.reset();
    hub = std::make_unique<FuzzedHub>();
  }
  hub->hear(text_of_input(data, size));
  return 0;
}
