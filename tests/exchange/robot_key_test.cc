#include "saker/exchange/robot_key.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/exchange/key.h"
#include "two_ends.h"

namespace saker::exchange {
namespace {

void give_own_key(const std::filesystem::path& file) {
  make_robot_key_file(test_key(), "R1", file);
}

TEST(RobotKeyFile, IsReadWhereItIs) {
  const auto folder = test_folder();
  give_own_key(folder / "robot.key");
  give_own_key(folder / "team.key");
  const RobotKeyFile found = robot_key_file(folder / "robot.key");
  EXPECT_EQ(found.file, folder / "robot.key");
  EXPECT_EQ(found.note, "");
}

TEST(RobotKeyFile, IsReadUnderItsOldNameWithALineThatRenamesIt) {
  const auto folder = test_folder();
  give_own_key(folder / "team.key");
  const RobotKeyFile found = robot_key_file(folder / "robot.key");
  EXPECT_EQ(found.file, folder / "team.key");
  const std::string remedy = found.note.substr(found.note.find("mv "));
  EXPECT_EQ(std::system(remedy.c_str()), 0);
  EXPECT_EQ(robot_key_file(folder / "robot.key").file, folder / "robot.key");
  EXPECT_EQ(robot_key_file(folder / "robot.key").note, "");
}

TEST(RobotKeyFile, IsNotMissedWhereThereIsNoneOfEitherName) {
  const auto folder = test_folder();
  const RobotKeyFile found = robot_key_file(folder / "robot.key");
  EXPECT_EQ(found.file, folder / "robot.key");
  EXPECT_EQ(found.note, "");
}

TEST(RobotKeyFile, OfAnotherNameIsTakenAsConfigured) {
  const auto folder = test_folder();
  give_own_key(folder / "team.key");
  EXPECT_EQ(robot_key_file(folder / "R1.key").file, folder / "R1.key");
}

TEST(RobotKeyFile, WithTheTeamsKeyIsNotedUnderBothNames) {
  const auto folder = test_folder();
  make_key_file(folder / "team.key");
  const RobotKeyFile old = robot_key_file(folder / "robot.key");
  EXPECT_EQ(old.file, folder / "team.key");
  EXPECT_NE(old.note.find("is the team's key"), std::string::npos) << old.note;
  EXPECT_EQ(old.note.find("rename"), std::string::npos) << "the base's file keeps its name";
  make_key_file(folder / "robot.key");
  EXPECT_NE(robot_key_file(folder / "robot.key").note.find("robot.key is the team's key"),
            std::string::npos);
}

TEST(RobotKeyFile, ThatEverybodyMayReadIsRefusedUnderItsOldNameToo) {
  const auto folder = test_folder();
  give_own_key(folder / "team.key");
  std::filesystem::permissions(folder / "team.key", std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  EXPECT_THROW((void)robot_key_file(folder / "robot.key"), Error);
}

}  // namespace
}  // namespace saker::exchange
