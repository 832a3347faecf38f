// Certificates, passwords, the hub's program, its log, /health and /metrics.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "firmware/config/hub_tables.hpp"
#include "simulator/capture/input_error.hpp"
#include "tests/firmware/fleet/broker_process.hpp"
#include "tests/firmware/fleet/fleet_rig.hpp"
#include "tests/firmware/webhook/hub_program.hpp"
#include "tests/firmware/webhook/tls_receiver.hpp"

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

// What a broker with TLS reads.
class TlsFiles {
 public:
  explicit TlsFiles(const std::string& host, int valid_s) {
    const Certificate own(host, valid_s);
    const Certificate client("kitchen");
    const Certificate ended("kitchen", -60);
    own.write(path("broker.pem"));
    own.write_key(path("broker.key"));
    client.write(path("client.pem"));
    client.write_key(path("client.key"));
    ended.write(path("ended.pem"));
    ended.write_key(path("ended.key"));
    Certificate("other").write(path("other.pem"));
    write("passwords", "kitchen:secret word\nbar:secret word\ncollector:secret word\n");
    if (std::system(("mosquitto_passwd -U " + path("passwords")).c_str()) != 0)
      throw std::runtime_error("no passwords");
  }
  std::string path(const char* name) const { return (folder_.path() / name).string(); }
  void write(const char* name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    fs::permissions(path(name), fs::perms::owner_read | fs::perms::owner_write);
  }

 private:
  MemoryFolder folder_;
};

std::string by_password(const TlsFiles& files) {
  return "allow_anonymous false\npassword_file " + files.path("passwords") + "\n";
}

std::string by_certificate(const TlsFiles& files) {
  return "require_certificate true\nuse_identity_as_username true\ncafile " + files.path("client.pem") + "\n";
}

// A broker that calls itself `host`, and how to reach it.
class TlsBroker {
 public:
  explicit TlsBroker(const std::string& host = "localhost", int valid_s = 3600,
                     std::string (*access)(const TlsFiles&) = by_password)
      : files_(host, valid_s),
        broker_("persistence false\ncertfile " + path("broker.pem") + "\nkeyfile " + path("broker.key") +
                "\n" + access(files_)) {}
  std::string path(const char* name) const { return files_.path(name); }
  FleetConfig config(const char* password = "secret word") {
    return config_of(files_, broker_.port(), "kitchen", password);
  }
  BrokerProcess& broker() { return broker_; }

  static FleetConfig config_of(const TlsFiles& files, std::uint16_t port, const std::string& user,
                               const char* password = "secret word") {
    FleetConfig config = fleet_config(port);
    config.broker.host = "localhost";
    config.broker.is_encrypted = true;
    config.broker.trusted = files.path("broker.pem");
    config.name = user;
    if (password == nullptr) return config;
    files.write("password", std::string(password) + "\n");
    config.broker.user = user;
    config.broker.password_file = files.path("password");
    return config;
  }

 private:
  TlsFiles files_;
  BrokerProcess broker_;
};

// The log of a rig that has not got through, or "connected".
std::string outcome(const FleetConfig& config) {
  FleetRig rig(config);
  rig.put(1);
  rig.run_until([&] { return rig.fleet().is_connected() || !rig.log().empty(); });
  if (!rig.log().empty()) {
    EXPECT_LT(rig.run_for(milliseconds(400)), 160) << rig.log();
    EXPECT_TRUE(rig.run_until([&] { return !rig.fleet().trouble().empty(); })) << rig.log();
    return rig.log();
  }
  // What a broker says against a certificate comes after TLS 1.3 has begun.
  rig.run_for(milliseconds(50));
  return rig.log().empty() ? "connected" : rig.log();
}

TEST(FleetAccess, ByPassword) {
  TRAYGAUGE_NEED_BROKER();
  TlsBroker tls;
  EXPECT_EQ(outcome(tls.config()), "connected") << tls.broker().log();
  const std::string wrong = outcome(tls.config("secret words"));
  EXPECT_NE(wrong.find("refuses this client; correct fleet.user or fleet.password_file"), std::string::npos)
      << wrong;
  EXPECT_EQ(wrong.find("secret words"), std::string::npos);
  const std::string without = outcome(tls.config(nullptr));
  EXPECT_NE(without.find("takes nobody without a user"), std::string::npos) << without;
}

TEST(FleetAccess, AWrongCertificateIsNotTrusted) {
  TRAYGAUGE_NEED_BROKER();
  TlsBroker tls;
  FleetConfig config = tls.config();
  config.broker.trusted = tls.path("other.pem");
  std::string log = outcome(config);
  EXPECT_NE(log.find("is not trusted (self-signed certificate)"), std::string::npos) << log;
  EXPECT_NE(log.find("in fleet.ca"), std::string::npos) << log;
  config = tls.config();
  config.broker.host = "127.0.0.1";
  log = outcome(config);
  EXPECT_NE(log.find("is not trusted (IP address mismatch)"), std::string::npos) << log;
  TlsBroker other_name("till.example");
  log = outcome(other_name.config());
  EXPECT_NE(log.find("is not trusted (hostname mismatch)"), std::string::npos) << log;
  TlsBroker ended("localhost", -60);
  log = outcome(ended.config());
  EXPECT_NE(log.find("is not trusted (certificate has expired)"), std::string::npos) << log;
}

TEST(FleetAccess, ByCertificate) {
  TRAYGAUGE_NEED_BROKER();
  TlsBroker tls("localhost", 3600, by_certificate);
  FleetConfig config = tls.config(nullptr);
  std::string log = outcome(config);
  EXPECT_NE(log.find("refuses this client's certificate"), std::string::npos) << log;
  config.broker.certificate = tls.path("client.pem");
  config.broker.certificate_key = tls.path("client.key");
  EXPECT_EQ(outcome(config), "connected") << tls.broker().log();
  config.broker.certificate = tls.path("ended.pem");
  config.broker.certificate_key = tls.path("ended.key");
  log = outcome(config);
  EXPECT_NE(log.find("own certificate has ended: replace fleet.certificate"), std::string::npos) << log;
}

TEST(FleetAccess, PlainAndEncryptedMistakenForEachOther) {
  TRAYGAUGE_NEED_BROKER();
  TlsBroker tls;
  FleetConfig config = tls.config();
  config.broker.is_encrypted = false;
  std::string log = outcome(config);
  EXPECT_NE(log.find("mqtt://localhost"), std::string::npos) << log;
  BrokerProcess plain;
  config = tls.config();
  config.broker.port = plain.port();
  log = outcome(config);
  EXPECT_NE(log.find("mqtts://localhost"), std::string::npos) << log;
}

// config/fleet/mosquitto.conf with other paths.
std::string shipped_broker(const TlsFiles& files) {
  const fs::path folder = fs::path(TRAYGAUGE_SOURCE_DIR) / "config" / "fleet";
  std::ifstream stream(folder / "mosquitto.conf");
  std::string lines;
  for (std::string line; std::getline(stream, line);) {
    const std::map<std::string, std::string> others{
        {"listener", ""},
        {"certfile", "certfile " + files.path("broker.pem")},
        {"keyfile", "keyfile " + files.path("broker.key")},
        {"password_file", "password_file " + files.path("passwords")},
        {"acl_file", "acl_file " + (folder / "mosquitto.acl").string()},
        {"persistence_location", "persistence_location FOLDER/"}};
    const auto other = others.find(line.substr(0, line.find(' ')));
    lines += (other == others.end() ? line : other->second) + "\n";
  }
  return lines;
}

TEST(ShippedBroker, LetsEachHubSayItsOwnResultsAlone) {
  TRAYGAUGE_NEED_BROKER();
  const TlsFiles files("localhost", 3600);
  BrokerProcess broker(shipped_broker(files));
  Listener collector(TlsBroker::config_of(files, broker.port(), "collector").broker);
  FleetRig kitchen(TlsBroker::config_of(files, broker.port(), "kitchen"));
  kitchen.add(collector);
  Listener bar(TlsBroker::config_of(files, broker.port(), "bar").broker, "bar");
  kitchen.add(bar);
  ASSERT_TRUE(kitchen.run_until([&] {
    return kitchen.fleet().is_connected() && collector.is_connected() && bar.is_connected();
  })) << kitchen.log()
      << broker.log();
  kitchen.put(1);
  ASSERT_TRUE(kitchen.run_until([&] { return collector.ids.size() == 1; })) << broker.log();
  bar.say("traygauge/v1/kitchen/receipt", R"({"ids":["kitchen-1"]})");
  bar.say("traygauge/v1/kitchen/scan", R"({"event":"scan","id":"kitchen-2","scan":{}})");
  kitchen.run_for(milliseconds(200));
  EXPECT_EQ(kitchen.waiting(), 1) << "another hub gives no receipt";
  EXPECT_TRUE(bar.heard.empty()) << "nor does it hear of others";
  collector.give_receipts();
  EXPECT_TRUE(kitchen.run_until([&] { return kitchen.waiting() == 0; })) << kitchen.fleet().trouble();
  EXPECT_EQ(std::count(collector.ids.begin(), collector.ids.end(), "kitchen-2"), 0);
}

class FleetConfigTest : public testing::Test {
 protected:
  std::string error_of(const std::string& lines) {
    const fs::path file = folder_.path() / "station.toml";
    std::ofstream(file)
        << "[station]\nname = \"a\"\nsocket = \"s\"\nfolder = \"f\"\n[hub]\nstore = \"r.db\"\n"
        << "[fleet]\n"
        << lines;
    try {
      config_ = read_hub_file(file, file).fleet;
      const Expected<void> checked = Fleet::check(*config_);
      return checked.ok() ? "none" : checked.failure();
    } catch (const InputError& error) {
      return error.what();
    }
  }
  MemoryFolder folder_;
  std::optional<FleetConfig> config_;
};

TEST_F(FleetConfigTest, ReadsAllKeys) {
  EXPECT_EQ(error_of("host = \"broker.example\"\n"), "none");
  EXPECT_EQ(config_->broker.shown(), "mqtts://broker.example:8883");
  EXPECT_EQ(config_->name, "a");
  EXPECT_EQ(config_->delivery, FleetDelivery::receipt);
  EXPECT_EQ(
      error_of(
          "host = \"::1\"\ntls = false\nprefix = \"x/y\"\ndelivered = \"broker\"\nhome_assistant = true\n"),
      "none");
  EXPECT_EQ(config_->broker.shown(), "mqtt://[::1]:1883");
}

TEST_F(FleetConfigTest, ErrorsNameFileKeyExpectedAndFound) {
  const std::string host = "host = \"b\"\n";
  const auto expect = [&](const std::string& lines, std::initializer_list<const char*> parts) {
    const std::string error = error_of(lines);
    for (const char* const part : parts)
      EXPECT_NE(error.find(part), std::string::npos) << part << "\n" << error;
  };
  expect("", {"station.toml", "fleet.host"});
  expect("host = \"mqtt://b\"\n", {"station.toml", "8:", "fleet.host", "without scheme", "mqtt://b"});
  expect(host + "port = 0\n", {"fleet.port", "1 to 65535", "found 0"});
  expect(host + "tls = \"no\"\n", {"fleet.tls", "true or false"});
  expect(host + "tls = false\nca = \"x\"\n", {"fleet.ca", "no such key where tls is false"});
  expect(host + "certificate = \"x\"\n", {"fleet.certificate", "certificate_key beside"});
  expect(host + "password_file = \"x\"\n", {"fleet.password_file", "user beside"});
  expect(host + "user = \"a b\"\n", {"fleet.user", "visible characters"});
  expect(host + "prefix = \"a/#\"\n", {"fleet.prefix", "levels of", "a/#"});
  expect(host + "delivered = \"maybe\"\n", {"fleet.delivered", "\"receipt\" or \"broker\""});
  expect(host + "home_assistant_prefix = \"+\"\n", {"fleet.home_assistant_prefix"});
  expect(host + "topic = \"x\"\n", {"fleet.topic"});
  expect(host + "ca = \"absent\"\n", {"fleet.ca: ", "absent", "expected certificates in PEM"});
  expect(host + "user = \"a\"\npassword_file = \"absent\"\n", {"fleet.password_file: ", "cannot be read"});
  std::ofstream(folder_.path() / "open") << "very secret\n";
  expect(host + "user = \"a\"\npassword_file = \"open\"\n", {"fleet.password_file: ", "chmod 600"});
}

// The hub under its filter of system calls.
TEST(FleetProgram, DeliversByTls) {
  TRAYGAUGE_NEED_BROKER();
  TlsBroker tls;
  const FleetConfig config = tls.config();
  HubProgram hub("[fleet]\nhost = \"localhost\"\nport = " + std::to_string(config.broker.port) + "\nca = \"" +
                 tls.path("broker.pem") + "\"\nuser = \"kitchen\"\npassword_file = \"" +
                 tls.path("password") + "\"\n");
  Listener listener(config.broker);
  listener.give_receipts();
  const auto becomes_true = [&](const std::function<bool()>& is_true) {
    for (int i = 0; i < 1000 && !is_true(); ++i) {
      listener.step();
      std::this_thread::sleep_for(milliseconds(10));
    }
    return is_true();
  };
  ASSERT_TRUE(becomes_true([&] { return listener.is_connected(); }));
  hub.deliver(1);
  EXPECT_TRUE(becomes_true([&] { return !listener.ids.empty(); })) << hub.log() << tls.broker().log();
  EXPECT_TRUE(becomes_true([&] {
    return listener.last("traygauge/v1/kitchen/health")
               .find(R"({"name":"fleet","status":"ok","message":null})") != std::string::npos;
  })) << listener.last("traygauge/v1/kitchen/health");
  hub.kill();
  EXPECT_TRUE(becomes_true([&] { return listener.last("traygauge/v1/kitchen/status") == "offline"; }));
}

}  // namespace
}  // namespace traygauge::test
