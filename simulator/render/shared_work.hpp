// Work that all cores share.
#pragma once

#include <functional>

namespace traygauge {

// Calls task(0) to task(count - 1), each once, on `threads` threads (0: as many as there are cores), and
// progress(share), 0 to 1, from one of them at a time after each. Throws the first exception of a task, which
// ends the work.
void share_work(int count, int threads, const std::function<void(double share)>& progress,
                const std::function<void(int number)>& task);

}  // namespace traygauge
