// Shared work is done whole and once, and what goes wrong in it comes out.
#include "simulator/render/shared_work.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace traygauge {
namespace {

TEST(SharedWork, EachNumberIsCalledOnce) {
  for (const int threads : {0, 1, 3, 200}) {
    std::vector<std::atomic<int>> calls(100);
    share_work(100, threads, {}, [&](int number) { ++calls[static_cast<std::size_t>(number)]; });
    EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](int count) { return count == 1; })) << threads;
  }
}

TEST(SharedWork, NothingToDoCallsNothing) {
  share_work(0, 2, {}, [](int) { ADD_FAILURE(); });
}

TEST(SharedWork, ProgressGrowsToOne) {
  std::vector<double> shares;
  share_work(
      40, 3, [&](double share) { shares.push_back(share); }, [](int) {});
  ASSERT_EQ(shares.size(), 40U);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
}

TEST(SharedWork, AnExceptionEndsItAndComesOut) {
  for (const int threads : {1, 3}) {
    std::atomic<int> calls = 0;
    const auto task = [&](int number) {
      ++calls;
      if (number == 5) throw std::runtime_error("at five");
    };
    EXPECT_THROW(share_work(1000000, threads, {}, task), std::runtime_error);
    EXPECT_LT(calls, 1000000);
  }
}

}  // namespace
}  // namespace traygauge
