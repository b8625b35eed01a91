#include "saker/core/error.h"

#include <gtest/gtest.h>

#include "saker/core/one_line.h"

namespace saker {
namespace {

TEST(Error, IsOneLineWhateverWasFound) {
  EXPECT_STREQ(Error("a.bag: topic \"x\r\n\x1B[31m\", expected a name").what(),
               "a.bag: topic \"x???[31m\", expected a name");
}

TEST(OneLine, KeepsLettersOfEveryLanguage) {
  EXPECT_EQ(one_line("9.81 m/s², Straße\t1"), "9.81 m/s², Straße?1");
  EXPECT_EQ(one_line(""), "");
}

}  // namespace
}  // namespace saker
