#include "tests/firmware/collect/nats_cluster.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "firmware/base/file_descriptor.hpp"
#include "tests/firmware/webhook/receiver.hpp"
#include "tests/firmware/webhook/tls_receiver.hpp"

namespace traygauge::test {
namespace {

void write_secret(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
}

}  // namespace

std::string NatsCluster::program() {
  const char* const named = std::getenv("TRAYGAUGE_NATS");
  const std::string found = named != nullptr ? named : TRAYGAUGE_NATS_FETCHED;
  return ::access(found.c_str(), X_OK) == 0 ? found : std::string();
}

NatsCluster::NatsCluster() {
  const Certificate certificate("localhost");
  certificate.write(folder_.path() / "broker.pem");
  certificate.write_key(folder_.path() / "broker.key");
  write_secret(folder_.path() / "hubs", "of-the-hubs\n");
  write_secret(folder_.path() / "collector", "of-the-collector\n");
  {
    std::vector<FileDescriptor> taken;  // until all ports are known, so that none is given twice
    for (Node& node : nodes_) {
      for (std::uint16_t* const port : {&node.clients, &node.cluster, &node.mqtt})
        taken.push_back(listen_anywhere(*port));
    }
  }
  for (int node = 0; node < kNodes; ++node) {
    nodes_[static_cast<std::size_t>(node)].process =
        std::make_unique<LoggedProcess>(folder_.path() / ("log-" + std::to_string(node)));
    start(node);
  }
}

std::vector<std::string> NatsCluster::environment(int node) const {
  const auto at = [](std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); };
  const Node& own = nodes_[static_cast<std::size_t>(node)];
  const std::string number = std::to_string(node + 1);
  std::vector<std::string> variables{"TRAYGAUGE_NODE=traygauge-" + number,
                                     "TRAYGAUGE_CLIENTS=" + at(own.clients),
                                     "TRAYGAUGE_CLUSTER=" + at(own.cluster),
                                     "TRAYGAUGE_MQTT=" + at(own.mqtt),
                                     "TRAYGAUGE_STORE=" + (folder_.path() / ("store-" + number)).string(),
                                     "TRAYGAUGE_CERTIFICATE=" + (folder_.path() / "broker.pem").string(),
                                     "TRAYGAUGE_CERTIFICATE_KEY=" + (folder_.path() / "broker.key").string(),
                                     "TRAYGAUGE_HUBS_PASSWORD=of-the-hubs",
                                     "TRAYGAUGE_COLLECTOR_PASSWORD=of-the-collector"};
  for (int i = 0; i < kNodes; ++i)
    variables.push_back("TRAYGAUGE_ROUTE_" + std::to_string(i + 1) + "=nats://" +
                        at(nodes_[static_cast<std::size_t>(i)].cluster));
  return variables;
}

void NatsCluster::start(int node) {
  const std::string config = std::filesystem::path(TRAYGAUGE_SOURCE_DIR) / "config" / "fleet" / "nats.conf";
  nodes_[static_cast<std::size_t>(node)].process->start({program(), "-c", config}, environment(node));
}

void NatsCluster::kill(int node) {
  nodes_[static_cast<std::size_t>(node)].process->end(SIGKILL);
}

BrokerConfig NatsCluster::config(int node) const {
  BrokerConfig config;
  config.host = "localhost";
  config.port = nodes_[static_cast<std::size_t>(node)].mqtt;
  config.trusted = folder_.path() / "broker.pem";
  config.user = "hubs";
  config.password_file = folder_.path() / "hubs";
  return config;
}

std::string NatsCluster::collector_lines(int node) const {
  return "host = \"localhost\"\nport = " + std::to_string(config(node).port) + "\nca = \"" +
         (folder_.path() / "broker.pem").string() + "\"\nuser = \"collector\"\npassword_file = \"" +
         (folder_.path() / "collector").string() + "\"\n";
}

long NatsCluster::peak_kib(int node) const {
  return nodes_[static_cast<std::size_t>(node)].process->peak_kib();
}

}  // namespace traygauge::test
