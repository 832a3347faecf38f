// What a hub does with its store, by chance; and what is in the store afterwards, as text.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "firmware/store/open_store.hpp"

namespace traygauge::test {

// One action of a hub, the same whenever it is done to the same store.
struct WorkStep {
  enum class Kind { put, put_again, put_other, correct, deliver, fail_delivery, retain } kind = Kind::put;
  std::uint64_t number = 0;  // of the scan that it is about
  std::uint64_t chance = 0;  // what else there is to choose
};

// Puts are half of it; the others are about scans that were put before.
std::vector<WorkStep> sample_work(std::size_t steps, std::mt19937_64& random);

// A transaction without content: what can be read has to stay from then on.
Expected<void> change_nothing(Store& store);

// Ok where the store confirmed it, by a transaction.
Expected<void> do_step(Store& store, const WorkStep& step);

// All that the store holds, each row on a line; without what may differ between equal stores. A failure is
// told in the text.
std::string content_of(Store& store);

StoreOptions options_for_work(const std::filesystem::path& folder);

}  // namespace traygauge::test
