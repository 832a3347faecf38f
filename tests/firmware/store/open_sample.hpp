// A store in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "firmware/store/open_store.hpp"
#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/sample_scan.hpp"

namespace traygauge::test {

// Opens it; a failure fails the test, and gives null.
inline std::unique_ptr<Store> open_or_fail(const StoreOptions& options) {
  Expected<OpenedStore> opened = open_store(options, at(kMorningMs));
  if (!opened.ok()) {
    ADD_FAILURE() << opened.failure();
    return nullptr;
  }
  for (const std::string& notice : opened->notices) ADD_FAILURE() << notice;
  return std::move(opened->store);
}

class StoreTest : public testing::Test {
 protected:
  void SetUp() override { reopen(); }

  void reopen() {
    store_.reset();
    options_.file = folder_.path() / "results.db";
    store_ = open_or_fail(options_);
    ASSERT_NE(store_, nullptr);
  }

  // Expects that it is stored; gives its place in the order of arrival.
  std::int64_t put(const std::string& document, const WallTime& now = at(kMorningMs)) {
    const Expected<PutResult> result = store_->scans().put(document, now);
    if (!result.ok()) {
      ADD_FAILURE() << result.failure();
      return 0;
    }
    EXPECT_EQ(result->outcome, PutOutcome::stored) << result->why;
    return result->seq;
  }

  MemoryFolder folder_;
  StoreOptions options_;
  std::unique_ptr<Store> store_;
};

}  // namespace traygauge::test
