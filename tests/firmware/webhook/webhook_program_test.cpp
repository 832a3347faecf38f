// The hub as it ships, under its filter of system calls: it looks a name up, speaks TLS and signs; and it is
// killed again and again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/firmware/webhook/hub_program.hpp"
#include "tests/firmware/webhook/receiver.hpp"
#include "tests/firmware/webhook/tls_receiver.hpp"
#include "tests/support/becomes_true.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;

TEST(WebhookProgram, SpeaksTlsUnderItsFilter) {
  const MemoryFolder folder;
  const Certificate certificate("localhost");
  certificate.write(folder.path() / "ca.pem");
  const TlsReceiver receiver(certificate);
  HubProgram hub("webhook = \"https://localhost:" + std::to_string(receiver.port()) + "/\"\nwebhook_ca = \"" +
                 (folder.path() / "ca.pem").string() + "\"\n");
  hub.deliver(1);
  EXPECT_TRUE(becomes_true([&] { return receiver.answered() == 1; })) << hub.log();
}

TEST(WebhookProgram, KillsLoseNothingAndKeepTheOrder) {
  std::mt19937 random(random_seed());
  const auto take = [](const ReceivedMessage&) { return Reply::status(200); };
  const Receiver receiver(take);
  HubProgram hub("webhook = \"" + receiver.url() + "\"\n");
  std::vector<std::string> stored;
  for (std::uint64_t number = 1; number <= 200; ++number) {
    hub.deliver(number);
    stored.push_back(scan_id_text({"kitchen", number}));
    if (random() % 10 != 0) continue;
    std::this_thread::sleep_for(milliseconds(random() % 5));
    hub.kill();
    hub.start();
  }
  std::vector<std::string> first_times;
  EXPECT_TRUE(becomes_true([&] {
    first_times.clear();
    for (const std::string& id : receiver.event_ids()) {
      if (std::find(first_times.begin(), first_times.end(), id) == first_times.end())
        first_times.push_back(id);
    }
    return first_times.size() >= stored.size();
  })) << hub.log();
  EXPECT_EQ(first_times, stored);
  std::cout << stored.size() << " stored, told " << receiver.event_ids().size() << " times" << std::endl;
}

}  // namespace
}  // namespace traygauge::test
