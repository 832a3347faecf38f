// gnuplot as another program: found or not, failing, never ending.
#include "firmware/evaluate/gnuplot.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "tests/firmware/evaluate/search_path.hpp"
#include "tests/firmware/evaluate/svg_check.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kShort{300};

class Gnuplot : public testing::Test {
 protected:
  // A plot of three points with this script, in a folder of that name.
  Plot make_plot(const std::string& script, const std::string& name = "folder") {
    const fs::path own = folder_.path() / name;
    fs::create_directories(own);
    write_text(own / "common.gp",
               "set datafile separator ','\nset datafile columnheaders\nset terminal svg\n");
    write_text(own / "plot.gp", script);
    write_text(own / "data.csv", "a,b\n1,2\n2,3\n3,5\n");
    return {own / "plot.gp", own / "data.csv", own / "plot.svg", {"a \"title\", it's"}};
  }

  // A program called gnuplot, in a folder of its own.
  fs::path make_program(const std::string& script) const {
    const fs::path file = folder_.path() / "bin" / "gnuplot";
    fs::create_directories(file.parent_path());
    write_text(file, "#!/bin/sh\n" + script);
    fs::permissions(file, fs::perms::owner_all);
    return file.parent_path();
  }

  // What is said of a plot that cannot be drawn.
  static std::string fault_of(const Plot& plot, std::chrono::milliseconds timeout = kPlotTimeout) {
    std::ostringstream error;
    try {
      draw_plots({plot}, error, timeout);
    } catch (const PlotError& problem) {
      EXPECT_FALSE(fs::exists(plot.svg));
      EXPECT_EQ(error.str(), "");
      return problem.what();
    }
    ADD_FAILURE() << "drawn, or said: " << error.str();
    return "";
  }

  TemporaryFolder folder_;
};

constexpr const char* kScript =
    "set output ARG2\nset title ARG3\nplot ARG1 using (column('a')):(column('b')) with points pointtype 7\n";

TEST_F(Gnuplot, DrawsWhateverPathsHold) {
  for (const char* name : {"folder", "it's \"a\" folder", "$HOME `ls` %d; \\n", "<cat", "|cat", "-e", "~"}) {
    const Plot plot = make_plot(kScript, name);
    std::ostringstream error;
    draw_plots({plot}, error);
    EXPECT_EQ(error.str(), "");
    const std::string svg = read_text(plot.svg);
    EXPECT_EQ(find_svg_fault(svg), "") << name;
    EXPECT_EQ(count_in_curve(svg, 1, "<use"), 3U + 1U) << name;
    EXPECT_NE(svg.find("a \"title\", it's"), std::string::npos) << name;
  }
}

TEST_F(Gnuplot, TakesPathsFromTheCurrentFolder) {
  Plot plot = make_plot(kScript, "-e");
  const fs::path before = fs::current_path();
  fs::current_path(plot.script.parent_path());
  fs::rename("data.csv", "<cat");
  plot = {"plot.gp", "<cat", "|cat", {""}};
  std::ostringstream error;
  draw_plots({plot}, error);
  EXPECT_EQ(find_svg_fault(read_text("|cat")), "");
  fs::current_path(before);
}

TEST_F(Gnuplot, ThatIsNotInstalledIsNamedOnce) {
  const Plot plot = make_plot(kScript);
  write_text(plot.svg, "of an earlier evaluation");
  write_text(folder_.path() / "file", "");
  for (const fs::path& path : {folder_.path() / "absent", folder_.path() / "file", fs::path()}) {
    const SearchPath search(path);
    std::ostringstream error;
    draw_plots({plot, plot}, error);
    EXPECT_EQ(error.str(), "no plots: gnuplot is not installed; install the package gnuplot-nox\n");
    EXPECT_FALSE(fs::exists(plot.svg));
  }
}

TEST_F(Gnuplot, ThatFailsIsQuoted) {
  const std::string fault = fault_of(make_plot("set output ARG2\nplot no_such_variable\n"));
  EXPECT_NE(fault.find("plot.svg: not drawn: gnuplot failed with exit status 1 and said: "),
            std::string::npos)
      << fault;
  EXPECT_NE(fault.find("undefined variable: no_such_variable"), std::string::npos) << fault;
  EXPECT_EQ(fault.find('\n'), std::string::npos);
  Plot nowhere = make_plot(kScript);
  nowhere.svg = folder_.path() / "absent" / "plot.svg";
  EXPECT_NE(fault_of(nowhere).find("cannot open file"), std::string::npos);
}

TEST_F(Gnuplot, ThatIsKilledIsNamed) {
  const SearchPath search(make_program("kill -9 $$\n"));
  EXPECT_NE(fault_of(make_plot(kScript)).find("gnuplot was ended: Killed"), std::string::npos);
}

TEST_F(Gnuplot, ThatSaysMuchIsCutShort) {
  const SearchPath search(
      make_program("i=0\nwhile [ $i -lt 20000 ]; do echo word >&2; i=$((i + 1)); done\nexit 3\n"));
  const std::string fault = fault_of(make_plot(kScript));
  EXPECT_NE(fault.find("exit status 3 and said: word word"), std::string::npos);
  EXPECT_LT(fault.size(), 6000U);
}

TEST_F(Gnuplot, ThatNeverEndsIsEnded) {
  const std::string fault = fault_of(make_plot("set output ARG2\nplot x\npause 60\n"), kShort);
  EXPECT_NE(fault.find("gnuplot took longer than 300 ms"), std::string::npos) << fault;
}

}  // namespace
}  // namespace traygauge
