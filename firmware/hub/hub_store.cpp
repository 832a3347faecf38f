#include "firmware/hub/hub_store.hpp"

#include <utility>

namespace traygauge {

Expected<HubStore> HubStore::open(HubStoreParams params) {
  HubStore hub_store(std::move(params));
  if (const auto opened = hub_store.reopen(); !opened.ok()) return Failure{opened.failure()};
  return hub_store;
}

Expected<std::vector<std::string>> HubStore::reopen() {
  tried_at_ = std::chrono::steady_clock::now();
  // One process has the file at a time: this one has to let go of it first.
  store_.reset();
  Expected<OpenedStore> opened = open_store(params_.options, read_wall_clock());
  if (!opened.ok()) {
    problem_ = opened.failure();
    return Failure{problem_};
  }
  store_ = std::move(opened->store);
  problem_.clear();
  ++openings_;
  for (const std::string& name : opened->new_destinations)
    opened->notices.push_back("From now on the " + name +
                              " is told of scans and corrections; it is not told of earlier ones.");
  for (const std::string& notice : opened->notices) add_notice(notice);
  return std::move(opened->notices);
}

std::vector<std::string> HubStore::tend(std::chrono::steady_clock::time_point now) {
  std::vector<std::string> sentences;
  if (store_ == nullptr || store_->is_damaged()) {
    if (store_ == nullptr && now - tried_at_ < params_.reopen_after) return sentences;
    const std::string before = problem_;
    const Expected<std::vector<std::string>> notices = reopen();
    if (!notices.ok()) {
      if (notices.failure() != before) sentences.push_back(notices.failure());
      return sentences;
    }
    if (!before.empty()) sentences.emplace_back("The store of results can be used again.");
    sentences.insert(sentences.end(), notices->begin(), notices->end());
    return sentences;
  }
  if (now - tidied_at_ < params_.tidy_every) return sentences;
  tidied_at_ = now;
  const Expected<RetentionReport> report = store_->retention().run(params_.retention, read_wall_clock(), now);
  if (!report.ok()) {
    sentences.push_back(report.failure());
    return sentences;
  }
  if (report->has_more) tidied_at_ = {};  // the next turn goes on
  if (!report->text.empty()) {
    sentences.push_back(report->text);
    add_notice(report->text);
  }
  return sentences;
}

void HubStore::add_notice(const std::string& text) {
  constexpr std::size_t kMaxNotices = 100;
  if (!notices_.empty() && notices_.back() == text) return;
  notices_.push_back(text);
  if (notices_.size() > kMaxNotices) notices_.pop_front();
}

}  // namespace traygauge
