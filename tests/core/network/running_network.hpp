// A composed network, parsed and ready to run, in memory of its own.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include "core/network/network_file.hpp"
#include "core/network/network_runner.hpp"
#include "tests/support/network_composer.hpp"

namespace traygauge::test {

class RunningNetwork {
 public:
  explicit RunningNetwork(const ComposedNetwork& composed) : file_(compose_network(composed)) {
    EXPECT_EQ(parse_network(file_, network_), NetworkFileStatus::ok);
    const std::size_t bytes = required_bytes(network_);
    block_.reset(static_cast<std::byte*>(::operator new (bytes, std::align_val_t{kArenaAlignmentBytes})));
    runner_ = std::make_unique<NetworkRunner>(network_, std::span(block_.get(), bytes));
  }

  void run(const std::vector<std::uint8_t>& picture) {
    ASSERT_EQ(picture.size(), static_cast<std::size_t>(runner_->input().width * runner_->input().height));
    std::copy(picture.begin(), picture.end(), runner_->input().data);
    runner_->run();
  }
  std::vector<std::uint8_t> output(NetworkRole role) const {
    const TensorView view = runner_->output(role);
    return {view.data, view.data + view.shape.bytes()};
  }
  const Network& network() const { return network_; }
  NetworkRunner& runner() { return *runner_; }

 private:
  struct Free {
    void operator()(std::byte* block) const {
      ::operator delete (block, std::align_val_t{kArenaAlignmentBytes});
    }
  };
  std::vector<std::byte> file_;
  Network network_;
  std::unique_ptr<std::byte, Free> block_;
  std::unique_ptr<NetworkRunner> runner_;
};

}  // namespace traygauge::test
