// Runs a fuzz target over each file of the folders named, and over its beginnings, at most some 64 of them:
// for compilers without libFuzzer, and as a test that the seeds still pass.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_target.hpp"

namespace {

int run_folder(const std::filesystem::path& folder) {
  int runs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    constexpr std::size_t kMaxBeginnings = 64;
    const std::size_t step = bytes.size() / kMaxBeginnings + 1;
    for (std::size_t cut = 0; cut <= bytes.size(); cut += step, ++runs) {
      const std::size_t size = bytes.size() - cut;
      const std::vector<std::uint8_t> input(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      LLVMFuzzerTestOneInput(input.data(), input.size());
    }
  }
  return runs;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    int runs = 0;
    for (int i = 1; i < argc; ++i) runs += run_folder(argv[i]);
    std::printf("%d runs\n", runs);
    return runs > 0 ? 0 : 1;
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
}
