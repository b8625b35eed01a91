#include "saker/exchange/key.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "two_ends.h"

namespace saker::exchange {
namespace {

using std::filesystem::perms;

/// The message of the Error that reading the file ends in; empty where there is none.
std::string fault_of(const std::filesystem::path& file) {
  try {
    (void)read_key(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(KeyFile, IsReadAsItWasMade) {
  const auto folder = test_folder();
  make_key_file(folder / "a");
  make_key_file(folder / "b");
  EXPECT_EQ(read_key(folder / "a"), read_key(folder / "a"));
  EXPECT_NE(read_key(folder / "a"), read_key(folder / "b"));
}

TEST(KeyFile, IsReadableByItsOwnerOnly) {
  const auto file = test_folder() / "key";
  make_key_file(file);
  EXPECT_EQ(std::filesystem::status(file).permissions(), perms::owner_read | perms::owner_write);
}

TEST(KeyFile, AnExistingOneIsNotReplaced) {
  const auto file = test_folder() / "key";
  make_key_file(file);
  const Key key = read_key(file);
  EXPECT_THROW(make_key_file(file), Error);
  EXPECT_EQ(read_key(file), key);
}

TEST(KeyFile, OneThatEverybodyMayReadIsRefusedWithTheCommandThatMendsIt) {
  const auto file = test_folder() / "key";
  make_key_file(file);
  std::filesystem::permissions(file, perms::group_read | perms::others_read,
                               std::filesystem::perm_options::add);
  EXPECT_NE(fault_of(file).find("(mode 0644), mend with: chmod o-rwx"), std::string::npos);
  std::filesystem::permissions(file, perms::others_read, std::filesystem::perm_options::remove);
  EXPECT_EQ(fault_of(file), "");
}

TEST(KeyFile, WhatIsNoKeyIsRefused) {
  const auto file = test_folder() / "key";
  for (const std::string& text : {std::string(), std::string(63, 'a'), std::string(66, 'a'),
                                  std::string(64, 'g'), std::string(62, 'a') + " a"}) {
    core::write_file(file, text);
    std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
    EXPECT_NE(fault_of(file).find("expected 64 hexadecimal digits"), std::string::npos) << text;
  }
  EXPECT_NE(fault_of(test_folder() / "none").find("cannot read"), std::string::npos);
}

TEST(RobotsKey, FollowsFromTheTeamsNameByNameAndRenewalByRenewal) {
  Key team = test_key();
  const Key r1 = key_of(team, "R1").value();
  EXPECT_EQ(key_of(team, "R1").value(), r1);
  EXPECT_NE(key_of(team, "R2").value(), r1);
  EXPECT_NE(key_of(team, "R1").value(), team);
  ++team.renewed["R1"];
  EXPECT_NE(key_of(team, "R1").value(), r1);
}

TEST(RobotsKey, LeadsToNoOther) {
  const Key r1 = key_of(test_key(), "R1").value();
  EXPECT_EQ(key_of(r1, "R1").value(), r1);
  EXPECT_FALSE(key_of(r1, "R2"));
  EXPECT_THROW(make_robot_key_file(r1, "R2", test_folder() / "key"), Error);
}

TEST(RobotsKey, IsReadAsItWasMade) {
  const auto folder = test_folder();
  make_key_file(folder / "team");
  const Key team = read_key(folder / "team");
  make_robot_key_file(team, "R1", folder / "r1");
  const Key r1 = read_key(folder / "r1");
  EXPECT_EQ(r1.robot, "R1");
  EXPECT_EQ(r1, key_of(team, "R1").value());
  EXPECT_EQ(std::filesystem::status(folder / "r1").permissions(),
            perms::owner_read | perms::owner_write);
  EXPECT_THROW(make_robot_key_file(team, "R1", folder / "r1"), Error) << "it is there";
  EXPECT_THROW(make_robot_key_file(team, "no name", folder / "r2"), Error);
}

TEST(RobotsKey, RenewedItIsAnotherAndThatOfOthersStays) {
  const auto folder = test_folder();
  make_key_file(folder / "team");
  const Key before = read_key(folder / "team");
  renew_key(folder / "team", "R1", folder / "r1");
  renew_key(folder / "team", "R3", folder / "r3");
  renew_key(folder / "team", "R1", folder / "r1");
  const Key after = read_key(folder / "team");
  EXPECT_EQ(after, before);
  EXPECT_EQ(after.renewed, (std::map<std::string, std::uint32_t>{{"R1", 2}, {"R3", 1}}));
  EXPECT_NE(key_of(after, "R1"), key_of(before, "R1"));
  EXPECT_EQ(key_of(after, "R2"), key_of(before, "R2"));
  EXPECT_EQ(std::filesystem::status(folder / "team").permissions(),
            perms::owner_read | perms::owner_write);
}

TEST(RobotsKey, RenewedItIsInBothFilesAndWhoMayReadThemStays) {
  const auto folder = test_folder();
  make_key_file(folder / "team");
  make_robot_key_file(read_key(folder / "team"), "R1", folder / "r1");
  const auto group = perms::owner_read | perms::owner_write | perms::group_read;
  std::filesystem::permissions(folder / "team", group);
  renew_key(folder / "team", "R1", folder / "r1");
  EXPECT_EQ(read_key(folder / "r1"), key_of(read_key(folder / "team"), "R1"));
  EXPECT_EQ(std::filesystem::status(folder / "team").permissions(), group);
  make_robot_key_file(read_key(folder / "team"), "R2", folder / "r1", Existing::replaced);
  EXPECT_EQ(read_key(folder / "r1").robot, "R2");
}

TEST(RobotsKey, ThatCannotBeWrittenIsNotRenewed) {
  const auto folder = test_folder();
  make_key_file(folder / "team");
  const std::string before = core::read_file(folder / "team");
  EXPECT_THROW(renew_key(folder / "team", "R1", folder / "none" / "r1"), Error);
  EXPECT_EQ(core::read_file(folder / "team"), before) << "the robot's key of before still holds";
}

TEST(RobotsKey, IsRenewedInTheTeamsFileAlone) {
  const auto folder = test_folder();
  make_robot_key_file(test_key(), "R1", folder / "r1");
  EXPECT_THROW(renew_key(folder / "r1", "R1", folder / "new"), Error);
  make_key_file(folder / "team");
  EXPECT_THROW(renew_key(folder / "team", "no name", folder / "new"), Error);
}

TEST(RobotsKey, IsOnlyThatRobots) {
  const Key r1 = key_of(test_key(), "R1").value();
  EXPECT_NO_THROW(require_key_of(r1, "R1"));
  EXPECT_NO_THROW(require_key_of(test_key(), "R2"));
  EXPECT_THROW(require_key_of(r1, "R2"), Error);
}

TEST(RobotsKey, OnlyTheTeamsInItsPlaceIsNoted) {
  const auto folder = test_folder();
  EXPECT_EQ(team_key_note(folder / "none"), "");
  make_key_file(folder / "team");
  make_robot_key_file(read_key(folder / "team"), "R1", folder / "r1");
  EXPECT_EQ(team_key_note(folder / "r1"), "");
  EXPECT_NE(team_key_note(folder / "team").find("team is the team's key"), std::string::npos);
}

TEST(RobotsKey, LinesThatSayNothingAreRefused) {
  const auto file = test_folder() / "key";
  const std::string digits(64, 'a');
  for (const std::string& text :
       {digits + "\nR1", digits + "\nR1 x", digits + "\nR1 1x", digits + "\nr1 1", digits + "\nR1 ",
        "R1 " + digits + "\nR2 1", "r1 " + digits, "R1 " + digits + "0"}) {
    core::write_file(file, text);
    std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
    EXPECT_NE(fault_of(file).find("expected 64 hexadecimal digits"), std::string::npos) << text;
  }
  core::write_file(file, digits + "\r\n\nR1 1\n");
  std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
  EXPECT_EQ(fault_of(file), "");
}

}  // namespace
}  // namespace saker::exchange
