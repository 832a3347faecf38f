// How long a call holds its thread.
#pragma once

#include <sys/resource.h>

#include <chrono>

namespace traygauge::test {

// 0 where the kernel gave the processor to others meanwhile, though the call had something to do: then it
// says nothing about the call. A call that waits for something is not interrupted so.
template <class Call>
std::chrono::microseconds call_time(Call call) {
  const auto interruptions = [] {
    rusage usage{};
    ::getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_nivcsw;
  };
  const auto interruptions_before = interruptions();
  const auto begin = std::chrono::steady_clock::now();
  call();
  const auto took = std::chrono::steady_clock::now() - begin;
  if (interruptions() != interruptions_before) return {};
  return std::chrono::duration_cast<std::chrono::microseconds>(took);
}

}  // namespace traygauge::test
