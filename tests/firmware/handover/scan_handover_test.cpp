#include "firmware/handover/scan_handover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/pipeline/measurement.hpp"
#include "firmware/journal/posix_file_system.hpp"
#include "firmware/station/scan_printer.hpp"
#include "tests/firmware/handover/drawn_tray.hpp"
#include "tests/firmware/handover/fake_hub.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

class Handover : public ::testing::Test {
 protected:
  Handover() {
    item_.label = 2;
    item_.volume_ml = 100.0;
    measurement_.items = {&item_, 1};
    result_.measurement = &measurement_;
    result_.outcome = ScanOutcome::measured;
  }

  std::filesystem::path socket() const { return folder_.path() / "hub"; }

  // A program's life: opens what is on disk, and closes it.
  struct Run {
    Run(const std::filesystem::path& folder, std::ostream& out, std::ostream& log)
        : printer(out, log, ScanPrinter::Format::text), kept(opened(folder)), link(link_params(folder)) {
      params.retry_after = Milliseconds(0);
      sink.emplace(printer, link, kept, log, params);
    }
    static KeptResults opened(const std::filesystem::path& folder) {
      return std::move(
          *KeptResults::open(posix_file_system(), {folder, "kitchen", std::uint64_t{512} * 1024}));
    }
    static HubLinkParams link_params(const std::filesystem::path& folder) {
      HubLinkParams params;
      params.socket = folder / "hub";
      params.station = "kitchen";
      params.answer_timeout = Milliseconds(200);
      params.retry_after = Milliseconds(0);
      return params;
    }
    ScanPrinter printer;
    KeptResults kept;
    HubLink link;
    ScanHandoverParams params;
    std::optional<ScanHandover> sink;
  };

  static std::vector<Json> scans(const FakeHub& hub) {
    std::vector<Json> documents;
    for (const Message& message : hub.received(MessageType::scan))
      documents.push_back(Json::parse(message.bytes));
    return documents;
  }

  TemporaryFolder folder_;
  std::ostringstream out_;
  std::ostringstream log_;
  ItemResult item_;
  Measurement measurement_;
  ScanResult result_;
};

TEST_F(Handover, IsDoneOnceTheHubHasStored) {
  const FakeHub hub(socket(), store_all);
  Run run(folder_.path(), out_, log_);
  EXPECT_EQ(run.sink->deliver(result_), Delivery::done);
  EXPECT_EQ(run.kept.waiting_count(), 0U);
  const auto documents = scans(hub);
  ASSERT_EQ(documents.size(), 1U);
  EXPECT_EQ(documents[0]["id"], "kitchen-1");
  EXPECT_EQ(documents[0]["station"], "kitchen");
  EXPECT_EQ(documents[0]["items"][0]["volume_ml"], 100.0);
  EXPECT_TRUE(documents[0]["supersedes"].is_null());
  EXPECT_NE(out_.str().find("100.0 ml"), std::string::npos);
}

// A hub that tells of the next tray as soon as it hears of the station.
FakeHub::Answer tell_of(const std::string& next_tray) {
  return [next_tray](const Message& message) {
    if (message.type == MessageType::hello)
      return std::vector<Message>{{MessageType::next_tray, next_tray, {}}};
    return store_all(message);
  };
}

TEST_F(Handover, ShowsAPictureOnlyWhereTheOwnerAllowsIt) {
  const std::vector<std::uint8_t> gray(64UL * 48UL, 100);
  result_.picture = {gray.data(), 64, 48, 64, PixelFormat::gray8};
  const FakeHub hub(socket(), store_all);
  for (const PicturePolicy policy : {PicturePolicy::hide, PicturePolicy::show, PicturePolicy::keep}) {
    Run run(folder_.path(), out_, log_);
    run.params.pictures = policy;
    ScanHandover sink(run.printer, run.link, run.kept, log_, run.params);
    const std::size_t before = hub.received(MessageType::picture).size();
    EXPECT_EQ(sink.deliver(result_), Delivery::done);
    sink.attend();
    EXPECT_EQ(sink.deliver(result_), Delivery::done);  // everything before it has arrived
    const std::vector<Message> pictures = hub.received(MessageType::picture);
    ASSERT_EQ(pictures.size(), before + (policy == PicturePolicy::hide ? 0U : 1U));
    if (policy == PicturePolicy::hide) continue;
    EXPECT_EQ(Json::parse(pictures.back().text)["keep"], policy == PicturePolicy::keep);
    EXPECT_EQ(pictures.back().bytes.substr(0, 3), "\xFF\xD8\xFF");
  }
}

TEST_F(Handover, KnowsOfTheNextTrayUntilItIsMeasured) {
  const FakeHub hub(socket(), tell_of(R"({"tray":"order 4711","foods":3,"dishes":[],"valid_ms":60000})"));
  Run run(folder_.path(), out_, log_);
  for (int i = 0; i < 500 && run.sink->next_tray().foods == 0; ++i) {
    run.sink->attend();
    std::this_thread::sleep_for(Milliseconds(10));
  }
  const TrayHint hint{"order 4711", 3, {}};
  EXPECT_EQ(run.sink->next_tray(), hint);
  ScanResult failed = result_;
  failed.outcome = ScanOutcome::not_measurable;
  EXPECT_EQ(run.sink->deliver(failed), Delivery::done);
  EXPECT_EQ(run.sink->next_tray(), hint);  // the next press is a second try
  EXPECT_EQ(run.sink->deliver(result_), Delivery::done);
  EXPECT_EQ(run.sink->next_tray(), TrayHint());
  bool was_shown = false;
  for (const Message& message : hub.received(MessageType::state)) {
    const Json next = Json::parse(message.text)["next_tray"];
    was_shown = was_shown || (next.is_object() && next["foods"] == 3);
  }
  EXPECT_TRUE(was_shown);
}

TEST_F(Handover, SaysWhatOfTheNextTrayIsOfNoUse) {
  const FakeHub hub(socket(), tell_of(R"({"foods":3,"dishes":["bowl"],"valid_ms":60000})"));
  Run run(folder_.path(), out_, log_);
  for (int i = 0; i < 500 && log_.str().find("of no use") == std::string::npos; ++i) {
    run.sink->attend();
    std::this_thread::sleep_for(Milliseconds(10));
  }
  EXPECT_NE(log_.str().find("of no use: dishes: expected none"), std::string::npos) << log_.str();
  EXPECT_EQ(run.sink->next_tray(), TrayHint());
}

TEST_F(Handover, ShowsTheHubWhatTheTrayLooksLikeOnce) {
  const DrawnTray tray;
  result_.measurement = &tray.measurement();
  const FakeHub hub(socket(), store_all);
  Run run(folder_.path(), out_, log_);
  EXPECT_EQ(run.sink->deliver(result_), Delivery::done);
  EXPECT_TRUE(hub.received(MessageType::shape).empty());  // the lamp comes first
  run.sink->attend();
  run.sink->attend();
  EXPECT_EQ(run.sink->deliver(result_), Delivery::done);  // everything before it has arrived
  const std::vector<Message> shapes = hub.received(MessageType::shape);
  ASSERT_EQ(shapes.size(), 1U);
  EXPECT_EQ(Json::parse(shapes[0].bytes)["id"], "kitchen-1");
}

TEST_F(Handover, IsKeptWhileTheHubIsAwayAndHandedOverInOrder) {
  {
    Run run(folder_.path(), out_, log_);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(run.sink->deliver(result_), Delivery::kept);
    EXPECT_EQ(run.kept.waiting_count(), 3U);
  }
  // Told once, not at each scan.
  const std::string log = log_.str();
  EXPECT_EQ(log.find("does not take results"), log.rfind("does not take results"));
  EXPECT_NE(log.find("does not take results"), std::string::npos);
  const FakeHub hub(socket(), store_all);
  Run run(folder_.path(), out_, log_);
  EXPECT_EQ(run.sink->deliver(result_), Delivery::done);
  EXPECT_EQ(run.kept.waiting_count(), 0U);
  std::vector<std::string> ids;
  for (const Json& document : scans(hub)) ids.push_back(document["id"]);
  ASSERT_EQ(ids.size(), 4U);
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
}

TEST_F(Handover, WhatWaitsLeavesBetweenScans) {
  Run run(folder_.path(), out_, log_);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(run.sink->deliver(result_), Delivery::kept);
  const FakeHub hub(socket(), store_all);
  run.sink->attend();
  EXPECT_EQ(run.kept.waiting_count(), 0U);
  EXPECT_EQ(scans(hub).size(), 3U);
  EXPECT_NE(log_.str().find("takes results again"), std::string::npos);
}

// A hub that stores and dies before it answers: the same document comes again, never another one of its id.
TEST_F(Handover, RepeatsTheVeryDocumentThatWasNotAnswered) {
  int refused = 0;
  const FakeHub hub(socket(), [&refused](const Message& message) -> std::vector<Message> {
    if (message.type == MessageType::scan && refused++ == 0) return {{MessageType::stored, kHangUp, {}}};
    return store_all(message);
  });
  Run run(folder_.path(), out_, log_);
  EXPECT_EQ(run.sink->deliver(result_), Delivery::kept);
  run.sink->attend();
  EXPECT_EQ(run.kept.waiting_count(), 0U);
  const auto received = hub.received(MessageType::scan);
  ASSERT_EQ(received.size(), 2U);
  EXPECT_EQ(received[0].bytes, received[1].bytes);
}

TEST_F(Handover, AFullHubKeepsResultsHere) {
  const FakeHub hub(socket(), [](const Message& message) -> std::vector<Message> {
    if (message.type != MessageType::scan) return {};
    const std::string id = Json::parse(message.text)["id"];
    return {{MessageType::refused, Json{{"id", id}, {"why", "results.db: the disk is full"}}.dump(), {}}};
  });
  Run run(folder_.path(), out_, log_);
  EXPECT_EQ(run.sink->deliver(result_), Delivery::kept);
  EXPECT_EQ(run.kept.waiting_count(), 1U);
  EXPECT_NE(log_.str().find("the disk is full"), std::string::npos);
}

TEST_F(Handover, TellsForHowLongWhatWaitsWasNotTaken) {
  std::atomic<bool> takes = false;
  const FakeHub hub(socket(), [&takes](const Message& message) -> std::vector<Message> {
    if (message.type != MessageType::scan || takes) return store_all(message);
    const std::string id = Json::parse(message.text)["id"];
    return {{MessageType::refused, Json{{"id", id}, {"why", "the disk is full"}}.dump(), {}}};
  });
  Run run(folder_.path(), out_, log_);
  const auto told = [&] {
    run.sink->report_state("waiting");
    run.link.deliver("kitchen-99", "{}");  // its answer comes after the state was read
    return Json::parse(hub.received(MessageType::state).back().text);
  };
  EXPECT_EQ(told()["queue_stands_s"], 0.0);
  EXPECT_EQ(run.sink->deliver(result_), Delivery::kept);
  run.sink->attend();
  std::this_thread::sleep_for(Milliseconds(20));
  const Json standing = told();
  EXPECT_EQ(standing["waiting_results"], 1);
  EXPECT_GE(standing["queue_stands_s"], 0.02);
  takes = true;
  run.sink->attend();
  const Json taken = told();
  EXPECT_EQ(taken["waiting_results"], 0);
  EXPECT_EQ(taken["queue_stands_s"], 0.0);
}

TEST_F(Handover, WhatTheHubSetAsideIsNotSentForEver) {
  const FakeHub hub(socket(), [](const Message& message) -> std::vector<Message> {
    if (message.type != MessageType::scan) return {};
    const std::string id = Json::parse(message.text)["id"];
    return {{MessageType::set_aside, Json{{"id", id}, {"why", "another document has this id"}}.dump(), {}}};
  });
  Run run(folder_.path(), out_, log_);
  EXPECT_EQ(run.sink->deliver(result_), Delivery::done);
  EXPECT_NE(log_.str().find("another document has this id"), std::string::npos);
}

TEST_F(Handover, SaysThatThereIsNoRoomAndThatThereIsAgain) {
  Run run(folder_.path(), out_, log_);
  int kept = 0;
  while (run.sink->has_room() && kept < 1000) {
    EXPECT_EQ(run.sink->deliver(result_), Delivery::kept);
    ++kept;
  }
  EXPECT_GT(kept, 50);
  EXPECT_LT(kept, 200);
  EXPECT_NE(log_.str().find("no room for a further result"), std::string::npos) << log_.str();
  const FakeHub hub(socket(), store_all);
  for (int i = 0; i < 100 && !run.sink->has_room(); ++i) run.sink->attend();
  EXPECT_TRUE(run.sink->has_room());
  EXPECT_NE(log_.str().find("can be kept again"), std::string::npos) << log_.str();
}

TEST_F(Handover, ARepeatedScanSupersedesTheLastOne) {
  const FakeHub hub(socket(), store_all);
  Run run(folder_.path(), out_, log_);
  ASSERT_EQ(run.sink->deliver(result_), Delivery::done);
  result_.repeats_last = true;
  ASSERT_EQ(run.sink->deliver(result_), Delivery::done);
  ASSERT_EQ(run.sink->deliver(result_), Delivery::done);
  const auto documents = scans(hub);
  ASSERT_EQ(documents.size(), 3U);
  EXPECT_EQ(documents[1]["supersedes"], "kitchen-1");
  EXPECT_EQ(documents[2]["supersedes"], "kitchen-2");
}

TEST_F(Handover, ACancelledScanIsNoResult) {
  const FakeHub hub(socket(), store_all);
  Run run(folder_.path(), out_, log_);
  ScanResult cancelled;
  cancelled.outcome = ScanOutcome::cancelled;
  EXPECT_EQ(run.sink->deliver(cancelled), Delivery::done);
  EXPECT_TRUE(hub.received(MessageType::scan).empty());
}

TEST_F(Handover, TellsTheHubWhatTheStationDoesAndWhatFails) {
  const FakeHub hub(socket(), store_all);
  Run run(folder_.path(), out_, log_);
  run.sink->report_state("waiting");
  run.sink->report_fault({"camera", DeviceCode::device_gone, "unplugged"});
  run.sink->report_recovery("all devices");
  run.sink->deliver(result_);  // its answer comes after everything before it was read
  const auto states = hub.received(MessageType::state);
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(Json::parse(states[0].text)["state"], "waiting");
  EXPECT_EQ(Json::parse(states[1].text)["faults"][0]["device"], "camera");
  EXPECT_EQ(Json::parse(states[1].text)["faults"][0]["status"], "device_gone");
  EXPECT_TRUE(Json::parse(states[2].text)["faults"].empty());
}

TEST_F(Handover, TellsTheHubOfDevicesBoardAndCalibration) {
  std::filesystem::create_directories(folder_.path() / "board/thermal/thermal_zone0");
  std::ofstream(folder_.path() / "board/thermal/thermal_zone0/temp") << "51234\n";
  const FakeHub hub(socket(), store_all);
  Run run(folder_.path(), out_, log_);
  run.params.heartbeat = Milliseconds(0);
  run.params.board_classes = folder_.path() / "board";
  run.params.facts.devices = {"camera serial:A2", "button TRIGGER"};
  run.params.facts.calibration = {0.31, "2025-01-31"};
  ScanHandover sink(run.printer, run.link, run.kept, log_, run.params);
  sink.attend();
  sink.deliver(result_);  // its answer comes after everything before it was read
  ASSERT_FALSE(hub.received(MessageType::state).empty());
  const Json state = Json::parse(hub.received(MessageType::state).back().text);
  EXPECT_EQ(scans(hub).back()["board"], (Json{{"temperature_c", 51.234}, {"under_voltage", nullptr}}));
  EXPECT_EQ(state["devices"], (Json{"camera serial:A2", "button TRIGGER"}));
  EXPECT_EQ(state["temperature_c"], 51.234);
  EXPECT_TRUE(state["under_voltage"].is_null());
  EXPECT_EQ(state["calibration"], (Json{{"grade_percent", 0.31}, {"calibrated_on", "2025-01-31"}}));
  EXPECT_TRUE(state["lens"].is_null());
}

TEST_F(Handover, TellsDirtOnTheLensUntilAScanShowsNone) {
  const FakeHub hub(socket(), store_all);
  Run run(folder_.path(), out_, log_);
  run.params.heartbeat = Milliseconds(0);
  ScanHandover sink(run.printer, run.link, run.kept, log_, run.params);
  const auto told = [&] {
    sink.deliver(result_);
    sink.attend();
    sink.deliver(result_);  // its answer comes after the state was read
    return Json::parse(hub.received(MessageType::state).back().text)["lens"];
  };
  result_.lens_spot = LensSpot{812.0, 344.0, 60.0};
  EXPECT_EQ(told(), lens_sentence(*result_.lens_spot));
  result_.lens_spot.reset();
  EXPECT_TRUE(told().is_null());
}

}  // namespace
}  // namespace traygauge::test
