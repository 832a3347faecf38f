// The core libraries refer to no symbol that allocates or throws, and the station's program holds nothing
// that it does not use of them. Unoptimised builds keep calls that can never be reached, so this looks at
// Release builds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

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

// Separated by '|'.
std::vector<std::string> core_archives() {
  std::vector<std::string> archives;
  std::istringstream list(TRAYGAUGE_CORE_ARCHIVES);
  for (std::string archive; std::getline(list, archive, '|');) archives.push_back(archive);
  return archives;
}

TEST(CoreSymbols, NoneAllocates) {
  if (std::string(TRAYGAUGE_BUILD_TYPE) != "Release") GTEST_SKIP() << "a " TRAYGAUGE_BUILD_TYPE " build";
  for (const std::string& archive : core_archives()) {
    EXPECT_FALSE(read_symbols(archive).defined.empty()) << archive << ": nm said nothing";
    for (const std::string& symbol : forbidden_symbols(archive)) {
      ADD_FAILURE() << archive << " refers to " << symbol;
    }
  }
}

// What is in none of the other archives of core, and in the station's program.
std::set<std::string> in_station(const std::string& archive) {
  std::set<std::string> own = read_symbols(archive).defined;
  for (const std::string& other : core_archives()) {
    if (other == archive) continue;
    for (const std::string& symbol : read_symbols(other).defined) own.erase(symbol);
  }
  const std::set<std::string> shipped = read_symbols(TRAYGAUGE_STATION).defined;
  std::set<std::string> both;
  std::set_intersection(own.begin(), own.end(), shipped.begin(), shipped.end(),
                        std::inserter(both, both.end()));
  std::erase_if(both,
                [](const std::string& symbol) { return symbol.find("traygauge::") == std::string::npos; });
  return both;
}

TEST(StationSymbols, HoldNothingOfThePaperNorOfEnrolment) {
  const std::vector<std::string> archives = core_archives();
  ASSERT_EQ(archives.size(), 3U) << "core, enrolment, paper";
  EXPECT_GT(in_station(archives[0]).size(), 100U) << "the product's own are there";
  for (const std::string& archive : {archives[1], archives[2]}) {
    for (const std::string& symbol : in_station(archive)) {
      ADD_FAILURE() << "traygauge-station holds " << symbol << " of " << archive;
    }
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
