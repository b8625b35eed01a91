#include "saker/core/progress.h"

#include <gtest/gtest.h>

#include "terminal.h"

namespace saker::core {
namespace {

TEST(Progress, TheBarSaysShareCountAndTimeLeft) {
  const std::string text = progress_text("replay", 50, 200, 10);
  EXPECT_NE(text.find("25 %"), std::string::npos) << text;
  EXPECT_NE(text.find("50 of 200"), std::string::npos) << text;
  EXPECT_NE(text.find("30 s left"), std::string::npos) << text;
}

TEST(Progress, WithoutATotalItCounts) {
  EXPECT_EQ(progress_text("replay", 50, 0, 10), "replay 50, 10 s");
}

TEST(Progress, NothingIsPrintedForWhatIsShort) {
  testing::internal::CaptureStderr();
  {
    Progress progress("replay", 10);
    for (int i = 0; i <= 10; ++i) progress.update(i);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, NeverExceedsTheWhole) {
  EXPECT_NE(progress_text("replay", 300, 200, 10).find("100 %"), std::string::npos);
  EXPECT_NE(progress_text("replay", 300, 200, 10).find(" 0 s left"), std::string::npos);
}

TEST(Progress, AtTheBeginningGuessesNoTime) {
  const std::string text = progress_text("replay", 0, 200, 10);
  EXPECT_EQ(text.find("left"), std::string::npos) << text;
  EXPECT_NE(text.find("0 %"), std::string::npos) << text;
}

TEST(Progress, BarIsOfOneLengthHoweverFarItIs) {
  const std::size_t length = progress_text("replay", 100, 999, 1000).size();
  EXPECT_EQ(progress_text("replay", 500, 999, 1000).size(), length - 1) << "998 and 8990 s left";
}

TEST(Progress, ALineIsCutBetweenCharactersToTheTerminalsWidth) {
  EXPECT_EQ(first_columns("height 3.4 m", 6), "height");
  EXPECT_EQ(first_columns("██ 50 %", 1), "█");
  EXPECT_EQ(first_columns("██ 50 %", 4), "██ 5");
  EXPECT_EQ(first_columns("short", 80), "short");
  EXPECT_EQ(first_columns("any width", 0), "any width");
}

TEST(StatusLine, WritesNothingWhereStderrIsNoTerminal) {
  testing::internal::CaptureStderr();
  {
    StatusLine line;
    EXPECT_FALSE(line.on_terminal());
    line.show("tour, target 3 of 8");
    line.keep();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(StatusLine, IsRewrittenOnATerminalAndCutToItsWidth) {
  const made::Terminal terminal(10);
  StatusLine line;
  ASSERT_TRUE(line.on_terminal());
  line.show("target 1 of 8");
  EXPECT_EQ(terminal.text(), "\r\033[Ktarget 1 o");
  line.show("target 2");
  EXPECT_EQ(terminal.text(), "\r\033[Ktarget 2");
  line.clear();
  line.clear();
  EXPECT_EQ(terminal.text(), "\r\033[K");
  line.show("landed");
  line.keep();
  EXPECT_EQ(terminal.text(), "\r\033[Klanded\r\n");
}

TEST(Progress, TheBarIsGoneAtItsEnd) {
  const made::Terminal terminal(80);
  { Progress("replay", 10).update(5); }
  const std::string text = terminal.text();
  EXPECT_NE(text.find("50 %"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\r\033[K")) << text;
}

}  // namespace
}  // namespace saker::core
