#include "saker/core/progress.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace saker::core
