#include "simulator/render/shared_work.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace traygauge {

void share_work(int count, int threads, const std::function<void(double share)>& progress,
                const std::function<void(int number)>& task) {
  std::atomic<int> next{0};
  std::mutex mutex;
  int done = 0;
  std::exception_ptr failure;
  const auto take_turns = [&] {
    try {
      for (int number = next++; number < count; number = next++) {
        task(number);
        if (!progress) continue;
        const std::lock_guard lock(mutex);
        ++done;
        progress(static_cast<double>(done) / count);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  if (threads == 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  {
    std::vector<std::jthread> workers;
    for (int i = 1; i < threads; ++i) workers.emplace_back(take_turns);
    take_turns();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace traygauge
