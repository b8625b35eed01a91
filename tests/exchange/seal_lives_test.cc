#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/exchange/seal.h"
#include "two_ends.h"

namespace {

/// What the disk has of the file that was synced last; whether it takes anything.
std::string on_disk;
bool disk_fails = false;

}  // namespace

// In place of the C library's: a power cut leaves what was synced, and nothing else for sure.
extern "C" int fdatasync(int file) {
  if (disk_fails) return -1;
  on_disk.assign(64 * 256, '\0');
  const ssize_t size = ::pread(file, on_disk.data(), on_disk.size(), 0);
  on_disk.resize(static_cast<std::size_t>(std::max<ssize_t>(0, size)));
  return 0;
}

namespace saker::exchange {
namespace {

constexpr const char* kChannel = "R1_EXCHANGE";
constexpr std::int64_t kStart = 1'800'000'000'000;  // ms of the system clock

std::string sealed(Sealer& sealer, const std::string& payload = "a message",
                   const std::string& channel = kChannel) {
  return sealer.seal(channel, payload).value();
}

/// A robot that seals and the base that opens, each with its key.
class Lives : public testing::Test {
 protected:
  void SetUp() override { disk_fails = false; }

  /// \param file  of its epoch, in this test's folder; empty: a new disk
  Sealer robot(std::int64_t start_ms, const std::string& file = "epoch") {
    return Sealer(key_of(team_, "R1").value(), "R1", file.empty() ? "" : folder_ / file, start_ms);
  }
  Opener base() { return Opener(team_, "BASE", folder_ / "heard"); }

  std::filesystem::path folder_ = test_folder();
  Key team_ = test_key();
};

TEST_F(Lives, ARobotThatLostItsFileIsTakenAgain) {
  Opener opener = base();
  Sealer before = robot(kStart);
  EXPECT_EQ(opener.open(kChannel, sealed(before)).verdict, Verdict::genuine);
  std::filesystem::remove(folder_ / "epoch");
  Sealer after = robot(kStart + 1);
  EXPECT_EQ(opener.open(kChannel, sealed(after)).verdict, Verdict::genuine);
}

TEST_F(Lives, NothingOfAnEarlierLifeIsTakenAfterALaterOne) {
  Opener opener = base();
  Sealer before = robot(kStart);
  const std::string heard = sealed(before), late = sealed(before);
  (void)opener.open(kChannel, heard);
  Sealer after = robot(kStart + 1);
  EXPECT_EQ(opener.open(kChannel, sealed(after)).verdict, Verdict::genuine);
  for (const std::string& message : {heard, late})
    EXPECT_EQ(opener.open(kChannel, message).verdict, Verdict::superseded);
  Opener restarted = base();
  EXPECT_EQ(restarted.open(kChannel, late).verdict, Verdict::superseded);
}

TEST_F(Lives, WithItsFileAClockThatWasSetBackDoesNotMatter) {
  Opener opener = base();
  for (const std::int64_t start : {kStart, kStart - 10'000'000, std::int64_t{-5}}) {
    Sealer sealer = robot(start);
    EXPECT_EQ(opener.open(kChannel, sealed(sealer)).verdict, Verdict::genuine) << start;
  }
}

TEST_F(Lives, WithoutFileAndClockItIsTakenWithARenewedKey) {
  Key& team = team_;
  const std::string before = [&] {
    Opener opener = base();
    Sealer sealer = robot(kStart);
    const std::string message = sealed(sealer);
    (void)opener.open(kChannel, message);
    Sealer lost = robot(0, "");
    EXPECT_EQ(opener.open(kChannel, sealed(lost)).verdict, Verdict::superseded);
    return message;
  }();
  ++team.renewed["R1"];
  Opener opener = base();
  Sealer renewed = robot(0, "");
  const std::string after = sealed(renewed);
  EXPECT_EQ(opener.open(kChannel, after).verdict, Verdict::genuine);
  EXPECT_EQ(opener.open(kChannel, after).verdict, Verdict::replayed);
  EXPECT_EQ(opener.open(kChannel, before).verdict, Verdict::forged) << "recorded of the old disk";
}

TEST_F(Lives, OfTwoRobotsOfOneNameTheLaterIsHeardAndNoNonceIsShared) {
  Opener opener = base();
  Sealer first = robot(kStart, "first"), second = robot(kStart, "second");
  const std::string one = sealed(first), two = sealed(second);
  EXPECT_NE(one.substr(4, 24), two.substr(4, 24));
  int genuine = 0, superseded = 0;
  for (int i = 0; i < 20; ++i) {
    for (Sealer* const sealer : {&first, &second}) {
      const Verdict verdict = opener.open(kChannel, sealed(*sealer)).verdict;
      genuine += verdict == Verdict::genuine;
      superseded += verdict == Verdict::superseded;
    }
  }
  EXPECT_GE(genuine, 20);
  EXPECT_GE(superseded, 19);
  EXPECT_EQ(genuine + superseded, 40);
}

TEST_F(Lives, ACopiedDiskDoesNotShareAnEpochEvenWithClocksSetBack) {
  (void)robot(kStart, "first");
  std::filesystem::copy_file(folder_ / "first", folder_ / "second");
  Sealer first = robot(0, "first"), second = robot(0, "second");
  const auto epoch = [&](Sealer& sealer) {
    return unsealed(team_, "BASE", kChannel, sealed(sealer)).epoch;
  };
  EXPECT_NE(epoch(first), epoch(second));
}

TEST_F(Lives, ARobotsKeyOpensAndSealsNothingOfAnother) {
  Sealer to_others(team_, "BASE", folder_ / "base");
  Opener robot(key_of(team_, "R2").value(), "R2", folder_ / "r2");
  EXPECT_EQ(robot.open(kChannel, sealed(to_others)).verdict, Verdict::forged);
  EXPECT_EQ(robot.open("R2_EXCHANGE", sealed(to_others, "x", "R2_EXCHANGE")).verdict,
            Verdict::genuine);
  Sealer other(key_of(team_, "R2").value(), "R2", "");
  EXPECT_FALSE(other.seal(kChannel, "x"));
}

TEST_F(Lives, WhoSealsForTwoRobotsIsHeardByBothKeys) {
  Sealer ground(team_, "GROUND", "");
  Opener opener = base();
  for (const char* channel : {"R1_ORDER", "R2_ORDER", "R1_ORDER"}) {
    const std::string order = sealed(ground, "hold", channel);
    EXPECT_EQ(opener.open(channel, order).verdict, Verdict::genuine);
    EXPECT_EQ(opener.open(channel, order).verdict, Verdict::replayed);
  }
}

TEST_F(Lives, WhatIsGivenOutIsOnTheDiskBefore) {
  Sealer sealer = robot(kStart);
  Opener opener = base();
  for (int i = 0; i < 30; ++i) {
    const std::string message = sealed(sealer);
    ASSERT_EQ(opener.open(kChannel, message).verdict, Verdict::genuine);
    core::write_file(folder_ / "after the power cut", on_disk);
    Opener after(team_, "BASE", folder_ / "after the power cut");
    ASSERT_EQ(after.open(kChannel, message).verdict, Verdict::replayed) << i;
  }
}

TEST_F(Lives, WhatTheDiskDoesNotTakeIsNotGivenOut) {
  Sealer sealer = robot(kStart);
  Opener opener = base();
  const std::string message = sealed(sealer);
  disk_fails = true;
  const Opened opened = opener.open(kChannel, message);
  EXPECT_EQ(opened.verdict, Verdict::unkept);
  EXPECT_EQ(opened.payload, "");
  disk_fails = false;
  EXPECT_EQ(opener.open(kChannel, message).verdict, Verdict::genuine);
}

TEST_F(Lives, ADamagedFileIsRefused) {
  { const Opener opener = base(); }
  std::string kept = core::read_file(folder_ / "heard");
  for (const std::size_t at : {0, 16}) {  // the sender's name, the robot's
    std::string damaged = kept;
    damaged.at(0) = damaged.at(16) = 'A';
    damaged[at] = '\x07';
    core::write_file(folder_ / "damaged", damaged);
    EXPECT_THROW(Opener(team_, "BASE", folder_ / "damaged"), Error) << at;
  }
}

TEST_F(Lives, AFileThatCannotBeGrownIsRefused) {
  EXPECT_THROW(Opener(team_, "BASE", "/dev/null"), Error);
}

TEST_F(Lives, WithoutAFileNothingIsWritten) {
  Sealer sealer = robot(kStart, "");
  EXPECT_TRUE(sealer.seal(kChannel, "x"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Lives, AFolderThatIsNotThereIsRefused) { EXPECT_THROW(robot(kStart, "none/epoch"), Error); }

}  // namespace
}  // namespace saker::exchange
