// The core library refers to no symbol that allocates or throws. Unoptimised builds keep calls that can never
// be reached, so this looks at Release builds.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <regex>
#include <set>
#include <string>

namespace {

struct Symbols {
  std::set<std::string> undefined;
  std::set<std::string> defined;
};

// nm prints "address type name", without an address for what is undefined: type U.
Symbols read_symbols(const std::string& archive) {
  static const std::regex kCode(R"([0-9a-f]+ [TtWw] (.*))");
  const std::string command = std::string(TRAYGAUGE_NM) + " -C '" + archive + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  Symbols symbols;
  std::array<char, 4096> line{};
  while (pipe != nullptr && std::fgets(line.data(), line.size(), pipe.get()) != nullptr) {
    std::string text = line.data();
    text.erase(text.find_last_not_of('\n') + 1);
    const std::size_t mark = text.find(" U ");
    std::smatch match;
    if (mark != std::string::npos) {
      symbols.undefined.insert(text.substr(mark + 3));
    } else if (std::regex_match(text, match, kCode)) {
      symbols.defined.insert(match[1]);
    }
  }
  return symbols;
}

std::set<std::string> forbidden_symbols(const std::string& archive) {
  static const std::regex kForbidden(
      R"((malloc|calloc|realloc|free|aligned_alloc|posix_memalign|memalign|strdup|alloca)(@.*)?|operator (new|delete).*|__cxa_(allocate_exception|throw)(@.*)?|std::__throw_.*)");
  std::set<std::string> found;
  for (const std::string& symbol : read_symbols(archive).undefined) {
    if (std::regex_match(symbol, kForbidden)) found.insert(symbol);
  }
  return found;
}

TEST(CoreSymbols, NoneAllocates) {
  if (std::string(TRAYGAUGE_BUILD_TYPE) != "Release") GTEST_SKIP() << "a " TRAYGAUGE_BUILD_TYPE " build";
  EXPECT_FALSE(read_symbols(TRAYGAUGE_CORE_ARCHIVE).defined.empty()) << "nm said nothing";
  for (const std::string& symbol : forbidden_symbols(TRAYGAUGE_CORE_ARCHIVE)) {
    ADD_FAILURE() << TRAYGAUGE_CORE_ARCHIVE << " refers to " << symbol;
  }
}

TEST(CoreSymbols, WouldBeFound) {
  const auto found = forbidden_symbols(TRAYGAUGE_SAMPLE_ARCHIVE);
  for (const char* symbol : {"malloc", "calloc", "realloc", "free", "__cxa_throw"}) {
    EXPECT_EQ(found.count(symbol), 1U) << symbol;
  }
  for (const char* beginning : {"operator new(", "operator new[](", "operator delete("}) {
    const auto next = found.lower_bound(beginning);
    EXPECT_TRUE(next != found.end() && next->rfind(beginning, 0) == 0) << beginning;
  }
}

}  // namespace
