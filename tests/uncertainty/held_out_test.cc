#include "saker/uncertainty/held_out.h"

#include <gtest/gtest.h>

#include <set>

namespace saker::uncertainty {
namespace {

const std::vector<std::string> kRecordings = {"d", "a", "c", "b", "e", "a", "c"};

TEST(HeldOutTest, EachRecordingIsHeldOutInExactlyOneFold) {
  std::map<std::string, int> times;
  int folds = 0;
  (void)held_out(kRecordings, 3, [&](const auto& is_held_out) {
    ++folds;
    for (const std::string& name : std::set<std::string>(kRecordings.begin(), kRecordings.end())) {
      times[name] += is_held_out(name);
    }
    return HeldOut{};
  });
  EXPECT_EQ(folds, 3);
  EXPECT_EQ(times.size(), 5u);
  for (const auto& [name, count] : times) EXPECT_EQ(count, 1) << name;
}

TEST(HeldOutTest, FoldsAreOfOneSizeButForOne) {
  std::vector<std::string> many;
  for (int i = 0; i < 23; ++i) many.push_back("flight_" + std::to_string(i));
  (void)held_out(many, 5, [&](const auto& is_held_out) {
    const auto count = std::count_if(many.begin(), many.end(), is_held_out);
    EXPECT_GE(count, 4);
    EXPECT_LE(count, 5);
    return HeldOut{};
  });
}

/// Scores the recordings of a fold by the number of those that were seen.
HeldOut scored(const std::vector<std::string>& recordings) {
  return held_out(recordings, 2, [](const auto& is_held_out) {
    double seen = 0;
    HeldOut scores;
    for (const std::string name : {"a", "b", "c", "d", "e"}) seen += !is_held_out(name);
    for (const std::string name : {"a", "b", "c", "d", "e"}) {
      if (is_held_out(name)) scores[name] = seen;
    }
    return scores;
  });
}

TEST(HeldOutTest, ScoresOfAllFoldsArePutTogether) {
  const HeldOut scores = scored(kRecordings);
  ASSERT_EQ(scores.size(), 5u);
  EXPECT_EQ(scores.at("a"), 2);
  EXPECT_EQ(scores.at("b"), 3);
}

TEST(HeldOutTest, TheOrderOfTheRecordingsDoesNotMatter) {
  std::vector<std::string> other(kRecordings.rbegin(), kRecordings.rend());
  EXPECT_EQ(scored(other), scored(kRecordings));
}

TEST(TrialTest, GainIsTheMeanDifferenceWithItsStandardError) {
  const HeldOut better = {{"a", 3}, {"b", 5}, {"c", 4}, {"d", 8}};
  const HeldOut worse = {{"a", 1}, {"b", 1}, {"c", 2}, {"d", 4}};
  const Trial result = trial("elevation", better, worse, 2);
  EXPECT_EQ(result.what, "elevation");
  EXPECT_NEAR(result.gain, 3, 1e-12);  // of 2, 4, 2, 4
  EXPECT_NEAR(result.standard_error, std::sqrt(4.0 / 3 / 4), 1e-12);
}

TEST(TrialTest, IsKeptBeyondSoManyStandardErrorsOnly) {
  const HeldOut better = {{"a", 3}, {"b", 5}, {"c", 4}, {"d", 8}};
  const HeldOut worse = {{"a", 1}, {"b", 1}, {"c", 2}, {"d", 4}};
  EXPECT_TRUE(trial("", better, worse, 5).kept);  // 3 is 5.2 of them
  EXPECT_FALSE(trial("", better, worse, 5.5).kept);
  EXPECT_FALSE(trial("", worse, better, 2).kept) << "a loss";
}

TEST(TrialTest, RecordingsThatOneSideLacksDoNotCount) {
  const HeldOut better = {{"a", 3}, {"b", 3}, {"x", 1000}};
  EXPECT_NEAR(trial("", better, {{"a", 1}, {"b", 2}}, 2).gain, 1.5, 1e-12);
}

TEST(TrialTest, OneRecordingProvesNothing) {
  EXPECT_FALSE(trial("", {{"a", 1000}}, {{"a", 0}}, 2).kept);
  EXPECT_FALSE(trial("", {}, {}, 2).kept);
}

}  // namespace
}  // namespace saker::uncertainty
