#include "tests/lint/include_rules.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace traygauge {
namespace {

namespace fs = std::filesystem;

TEST(IncludeRules, HoldInThisCheckout) {
  const ScanOfIncludes scan = scan_includes(TRAYGAUGE_ROOT);
  EXPECT_GT(scan.files, 50);
  EXPECT_GT(scan.includes, 200);
  for (const Breach& breach : scan.breaches) {
    ADD_FAILURE() << breach.path << ":" << breach.line << ": " << breach.reason;
  }
}

TEST(IncludeRules, ReadIncludeLines) {
  EXPECT_EQ(parse_include("#include <vector>")->path, "vector");
  EXPECT_FALSE(parse_include("#include <vector>")->in_quotes);
  EXPECT_EQ(parse_include("  #  include \"core/a.hpp\"  // why")->path, "core/a.hpp");
  EXPECT_TRUE(parse_include("#include \"core/a.hpp\"")->in_quotes);
  EXPECT_FALSE(parse_include("// #include <vector>"));
  EXPECT_FALSE(parse_include("#define INCLUDE <vector>"));
}

bool may(const char* path, const char* line) {
  return !forbids(path, parse_include(line).value());
}

TEST(IncludeRules, KeepCoreAlone) {
  for (const char* line : {"#include <span>", "#include <Eigen/Core>", "#include <hwy/highway.h>",
                           "#include \"core/base/arena.hpp\""}) {
    EXPECT_TRUE(may("core/stereo/a.cpp", line)) << line;
  }
  for (const char* line :
       {"#include <vector>", "#include <string>", "#include <map>", "#include <iostream>",
        "#include <functional>", "#include <cstdlib>", "#include <opencv2/core.hpp>", "#include <thread>",
        "#include <sys/mman.h>", "#include <nlohmann/json.hpp>", "#include \"drivers/camera.hpp\"",
        "#include \"simulator/a.hpp\"", "#include \"firmware/a.hpp\"", "#include \"tests/a.hpp\"",
        "#include \"arena.hpp\""}) {
    EXPECT_FALSE(may("core/stereo/a.cpp", line)) << line;
  }
}

TEST(IncludeRules, KeepTheOrderOfCoreAndTheProductApartFromThePaper) {
  EXPECT_TRUE(may("core/stereo/a.cpp", "#include \"core/image/a.hpp\""));
  EXPECT_TRUE(may("core/paper/stereo/a.cpp", "#include \"core/stereo/a.hpp\""));
  EXPECT_TRUE(may("core/paper/stereo/a.cpp", "#include \"core/paper/pipeline/a.hpp\""));
  EXPECT_FALSE(may("core/image/a.cpp", "#include \"core/stereo/a.hpp\""));
  EXPECT_FALSE(may("core/pipeline/a.cpp", "#include \"core/paper/pose/a.hpp\""));
  EXPECT_FALSE(may("core/pipeline/a.cpp", "#include \"core/enrolment/a.hpp\""));
  EXPECT_FALSE(may("core/elsewhere/a.cpp", "#include \"core/base/a.hpp\"")) << "no folder of the order";
}

TEST(IncludeRules, LetDriversKnowOnlyTheImageViewOfCore) {
  EXPECT_TRUE(may("drivers/a.cpp", "#include \"core/image_view/image_view.hpp\""));
  EXPECT_TRUE(may("drivers/a.cpp", "#include <linux/videodev2.h>"));
  EXPECT_TRUE(may("drivers/a.cpp", "#include <vector>"));
  for (const char* line :
       {"#include \"core/base/status.hpp\"", "#include <opencv2/core.hpp>", "#include <Eigen/Core>",
        "#include \"simulator/a.hpp\"", "#include \"firmware/a.hpp\""}) {
    EXPECT_FALSE(may("drivers/a.cpp", line)) << line;
  }
}

TEST(IncludeRules, KeepSimulatorBelowFirmwareAndEverythingAboveTests) {
  EXPECT_TRUE(may("simulator/a.cpp", "#include \"drivers/camera.hpp\""));
  EXPECT_TRUE(may("simulator/a.cpp", "#include <opencv2/core.hpp>"));
  EXPECT_FALSE(may("simulator/a.cpp", "#include \"firmware/a.hpp\""));
  EXPECT_TRUE(may("firmware/a.cpp", "#include \"simulator/a.hpp\""));
  EXPECT_FALSE(may("firmware/a.cpp", "#include \"tests/a.hpp\""));
}

TEST(IncludeRules, KeepHeavyHeadersOutOfMostSources) {
  EXPECT_TRUE(may("firmware/command/program.cpp", "#include <CLI/CLI.hpp>"));
  EXPECT_FALSE(may("firmware/command/program.hpp", "#include <CLI/CLI.hpp>"));
  EXPECT_FALSE(may("firmware/a.cpp", "#include <CLI/CLI.hpp>"));
  for (const char* line : {"#include <nlohmann/json.hpp>", "#include <toml++/toml.h>"}) {
    EXPECT_TRUE(may("simulator/a.cpp", line)) << line;
    EXPECT_FALSE(may("simulator/a.hpp", line)) << line;
  }
  EXPECT_TRUE(may("simulator/a.hpp", "#include <nlohmann/json_fwd.hpp>"));
}

TEST(IncludeRules, AreAppliedToEveryFileOfATree) {
  const fs::path root = fs::path(testing::TempDir()) / ("include_rules_" + std::to_string(getpid()));
  for (const char* folder : {"core/base/er", "drivers", "simulator", "firmware"}) {
    fs::create_directories(root / folder);
  }
  std::ofstream(root / "core/base/er/a.hpp") << "#pragma once\n#include <vector>\n";
  std::ofstream(root / "firmware/b.cpp") << "#include \"core/base/er/a.hpp\"\n#include \"core/absent.hpp\"\n";
  const ScanOfIncludes scan = scan_includes(root);
  fs::remove_all(root);
  EXPECT_EQ(scan.files, 2);
  EXPECT_EQ(scan.includes, 3);
  ASSERT_EQ(scan.breaches.size(), 2U);
  EXPECT_EQ(scan.breaches[0].path, "core/base/er/a.hpp");
  EXPECT_EQ(scan.breaches[0].line, 2);
  EXPECT_EQ(scan.breaches[1].path, "firmware/b.cpp");
  EXPECT_EQ(scan.breaches[1].line, 2);
}

}  // namespace
}  // namespace traygauge
