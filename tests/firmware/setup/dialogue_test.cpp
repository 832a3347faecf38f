#include "firmware/setup/dialogue.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace traygauge {
namespace {

struct Typed {
  explicit Typed(const std::string& lines) : in(lines), dialogue(in, out) {}
  std::istringstream in;
  std::ostringstream out;
  Dialogue dialogue;
};

TEST(Dialogue, TakesALineWithoutBlanksOrWhatIsUsual) {
  Typed typed(" 9x6 \t\r\n\n   \nlast without an end");
  EXPECT_EQ(typed.dialogue.ask("Corners?", "7x5"), "9x6");
  EXPECT_EQ(typed.dialogue.ask("Corners?", "7x5"), "7x5");
  EXPECT_EQ(typed.dialogue.ask("Name?"), "");
  EXPECT_EQ(typed.dialogue.ask("Name?"), "last without an end");
  EXPECT_THROW(typed.dialogue.ask("Name?", "usual"), DialogueEnded);
  EXPECT_NE(typed.out.str().find("Corners? [7x5] > "), std::string::npos) << typed.out.str();
}

TEST(Dialogue, ConfirmsByALetterAndAsksAgainForAnythingElse) {
  Typed typed("\n\ny\nNo\nn\nmaybe\nyes\nmaybe\n");
  EXPECT_TRUE(typed.dialogue.confirm("Sure?", true));
  EXPECT_FALSE(typed.dialogue.confirm("Sure?", false));
  EXPECT_TRUE(typed.dialogue.confirm("Sure?", false));
  EXPECT_FALSE(typed.dialogue.confirm("Sure?", true));  // "No" is asked again
  EXPECT_TRUE(typed.dialogue.confirm("Sure?", false));
  EXPECT_THROW(static_cast<void>(typed.dialogue.confirm("Sure?", true)), DialogueEnded);
}

TEST(Dialogue, AsksUntilTheAnswerIsGood) {
  Typed typed("a\nb\n");
  std::string taken;
  typed.dialogue.ask_until("Letter?", {}, [&taken](const std::string& answer) -> std::string {
    taken = answer;
    return answer == "b" ? "" : "Type b.";
  });
  EXPECT_EQ(taken, "b");
  EXPECT_NE(typed.out.str().find("Type b."), std::string::npos);
}

TEST(Dialogue, AfterAFailureEnterTriesAgain) {
  Typed typed("x\n\ns\nq\n");
  EXPECT_TRUE(typed.dialogue.try_again());
  EXPECT_FALSE(typed.dialogue.try_again());
  EXPECT_THROW(static_cast<void>(typed.dialogue.try_again()), DialogueEnded);
}

}  // namespace
}  // namespace traygauge
