#include "saker/core/text.h"

#include <gtest/gtest.h>

#include <vector>

#include "saker/core/short_list.h"

namespace saker::core {
namespace {

TEST(Text, IsWhatAStringWouldBe) {
  Text line = "no scan";
  line += std::string(" for ");
  line += text("{:.1f} s", 0.25);
  EXPECT_EQ(line, "no scan for 0.2 s");
  EXPECT_EQ(std::string(line), "no scan for 0.2 s");
  EXPECT_EQ(fmt::format("{}!", line), "no scan for 0.2 s!");
  EXPECT_EQ("it says: " + line + ".", std::string("it says: no scan for 0.2 s."));
  EXPECT_NE(line.find("scan"), std::string::npos);
  EXPECT_EQ(line.find("map"), std::string::npos);
  EXPECT_TRUE(Text().empty());
}

TEST(Text, IsCutWhereItEnds) {
  const std::string longer(Text::kMost + 100, 'x');
  EXPECT_EQ(Text(longer).size(), Text::kMost);
  EXPECT_EQ(text("{}", longer), longer.substr(0, Text::kMost));
  Text full = longer;
  full += "y";
  EXPECT_EQ(full.view().back(), 'x');
}

TEST(Text, IsCopiedWhole) {
  const Text first = "first";
  Text second = "a longer second one";
  second = first;
  EXPECT_EQ(second, "first");
  EXPECT_EQ(second, first);
  second = "";
  EXPECT_EQ(first, "first");
}

TEST(ShortList, KeepsTheFirstOnesInTheirOrderAndCountsTheOthers) {
  ShortList<int, 3> list;
  EXPECT_TRUE(list.empty());
  for (int i = 1; i <= 5; ++i) list.push_back(i);
  EXPECT_EQ(std::vector<int>(list.begin(), list.end()), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(list.front(), 1);
  EXPECT_EQ(list.back(), 3);
  EXPECT_EQ(list.dropped(), 2U);
  list.clear();
  EXPECT_EQ(list.size(), 0U);
}

TEST(ShortList, IsMadeOfAVector) {
  const std::vector<int> values{4, 5};
  const ShortList<int, 3> list = values;
  EXPECT_EQ(list.size(), 2U);
  EXPECT_EQ(list[1], 5);
}

}  // namespace
}  // namespace saker::core
