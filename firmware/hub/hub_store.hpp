// The store as the hub keeps it over years: opened anew where its file is damaged, and tidied.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/store/open_store.hpp"

namespace traygauge {

struct HubStoreParams {
  StoreOptions options;
  RetentionRules retention;
  std::chrono::seconds tidy_every{60};
  std::chrono::seconds reopen_after{5};  // an attempt that failed
};

// Used by one thread.
class HubStore {
 public:
  // Fails as open_store() does.
  static Expected<HubStore> open(HubStoreParams params);

  // Null while the file cannot be used: problem() says why.
  Store* store() { return store_.get(); }
  const Store* store() const { return store_.get(); }
  const std::string& problem() const { return problem_; }
  // How often it was opened: what was remembered of one store means nothing in the next one.
  std::uint64_t openings() const { return openings_; }
  // What people have to know of the file's past, the newest last: damaged files that were put aside, scans
  // that were deleted.
  const std::deque<std::string>& notices() const { return notices_; }

  // Does what is due: a short step, but for a damaged file, which is read whole. Returns sentences for the
  // log.
  std::vector<std::string> tend(std::chrono::steady_clock::time_point now);

 private:
  explicit HubStore(HubStoreParams params) : params_(std::move(params)) {}

  // What the opening has to tell.
  Expected<std::vector<std::string>> reopen();
  void add_notice(const std::string& text);

  HubStoreParams params_;
  std::unique_ptr<Store> store_;
  std::string problem_;
  std::uint64_t openings_ = 0;
  std::deque<std::string> notices_;
  std::chrono::steady_clock::time_point tidied_at_;
  std::chrono::steady_clock::time_point tried_at_;
};

}  // namespace traygauge
