#include "saker/exchange/seal.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <set>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "two_ends.h"

namespace saker::exchange {
namespace {

constexpr const char* kChannel = "R1_COMMAND";

/// A process that seals and one that opens, with files in a folder of this test's own.
class Seal : public testing::Test {
 protected:
  Sealer sealer(const std::string& name = "BASE") {
    return Sealer(test_key(), name, folder_ / (name + ".epoch"));
  }
  Opener opener() { return Opener(test_key(), "R1", folder_ / "heard"); }

  std::filesystem::path folder_ = test_folder();
};

std::string sealed(Sealer& sealer, std::string_view payload) {
  return sealer.seal(kChannel, payload).value();
}

TEST_F(Seal, WhatTheTeamSealsIsOpenedWithItsSender) {
  Sealer base = sealer();
  Opener robot = opener();
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, kLongestPayload}) {
    const std::string payload = some_bytes(size, size);
    const Opened opened = robot.open(kChannel, sealed(base, payload));
    EXPECT_EQ(opened.verdict, Verdict::genuine);
    EXPECT_EQ(opened.sender, "BASE");
    EXPECT_EQ(opened.payload, payload);
  }
}

TEST_F(Seal, IsLongerThanThePayloadByWhatItSays) {
  Sealer base = sealer("ABCDEFGHIJKLMNOP");
  EXPECT_EQ(sealed(base, "land").size(), 4 + kSealBytes);
  EXPECT_FALSE(base.seal(kChannel, std::string(kLongestPayload + 1, 'x')));
}

TEST_F(Seal, HidesThePayload) {
  Sealer base = sealer();
  EXPECT_EQ(sealed(base, "a text to look for").find("look for"), std::string::npos);
}

TEST_F(Seal, AnotherKeysMessageIsForged) {
  Key other = test_key();
  other[5] ^= 1;
  Sealer foreign(other, "BASE", folder_ / "foreign");
  Opener robot = opener();
  EXPECT_EQ(robot.open(kChannel, sealed(foreign, "land")).verdict, Verdict::forged);
}

TEST_F(Seal, AMessageOfAnotherChannelIsForged) {
  Sealer base = sealer();
  Opener robot = opener();
  EXPECT_EQ(robot.open("R2_COMMAND", sealed(base, "land")).verdict, Verdict::forged);
}

TEST_F(Seal, OnesOwnMessageIsKnown) {
  Sealer own = sealer("R1");
  Opener robot = opener();
  EXPECT_EQ(robot.open(kChannel, sealed(own, "land")).verdict, Verdict::own);
}

TEST_F(Seal, EveryCutIsCut) {
  Sealer base = sealer();
  Opener robot = opener();
  const std::string whole = sealed(base, "land");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_EQ(robot.open(kChannel, whole.substr(0, size)).verdict, Verdict::cut) << size;
  }
  EXPECT_EQ(robot.open(kChannel, whole + "x").verdict, Verdict::cut);
}

TEST_F(Seal, NothingIsTakenTwice) {
  Sealer base = sealer();
  Opener robot = opener();
  std::vector<std::string> messages;
  for (int i = 0; i < 3000; ++i) messages.push_back(sealed(base, "land"));
  for (const std::string& m : messages) {
    ASSERT_EQ(robot.open(kChannel, m).verdict, Verdict::genuine);
  }
  for (const std::string& m : messages) {
    ASSERT_EQ(robot.open(kChannel, m).verdict, Verdict::replayed);
  }
  EXPECT_EQ(robot.count(Verdict::replayed), 3000);
}

TEST_F(Seal, WhatComesInAnotherOrderIsTakenOnce) {
  Sealer base = sealer();
  Opener robot = opener();
  std::vector<std::string> messages;
  for (int i = 0; i < 1000; ++i) messages.push_back(sealed(base, "land"));
  core::Rng rng(1);
  for (int i = 999; i > 0; --i) std::swap(messages[i], messages[rng.index(i + 1)]);
  for (const std::string& m : messages) {
    ASSERT_EQ(robot.open(kChannel, m).verdict, Verdict::genuine);
    ASSERT_EQ(robot.open(kChannel, m).verdict, Verdict::replayed);
  }
}

TEST_F(Seal, NothingIsTakenTwiceAfterTheReceiversRestart) {
  Sealer base = sealer(), ground = sealer("GROUND");
  const std::string first = sealed(base, "hold"), late = sealed(base, "arm"),
                    second = sealed(base, "land"), other = sealed(ground, "land");
  {
    Opener robot = opener();
    for (const std::string* m : {&first, &second, &other}) {
      ASSERT_EQ(robot.open(kChannel, *m).verdict, Verdict::genuine);
    }
  }
  Opener restarted = opener();
  for (const std::string* m : {&first, &second, &other}) {
    EXPECT_EQ(restarted.open(kChannel, *m).verdict, Verdict::replayed);
  }
  EXPECT_EQ(restarted.open(kChannel, late).verdict, Verdict::genuine);
}

TEST_F(Seal, NoNonceComesTwiceAndEveryLifeIsTaken) {
  Opener robot = opener();
  std::set<std::string> nonces;
  for (int life = 0; life < 5; ++life) {
    Sealer base = sealer();
    for (int i = 0; i < 100; ++i) {
      const std::string message = sealed(base, "land");
      EXPECT_TRUE(nonces.insert(message.substr(6, 24)).second);  // behind version, 4, BASE
      EXPECT_EQ(robot.open(kChannel, message).verdict, Verdict::genuine);
    }
  }
}

/// Runs in a process of its own, which then is killed.
template <class Work>
void in_killed_process(const Work& work) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    work();
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

TEST_F(Seal, SurvivesKillMinusNineOfTheReceiver) {
  Sealer base = sealer();
  std::vector<std::string> messages;
  for (int i = 0; i < 200; ++i) messages.push_back(sealed(base, "land"));
  in_killed_process([&] {
    Opener robot = opener();
    for (int i = 0; i < 100; ++i) (void)robot.open(kChannel, messages[i]);
  });
  Opener robot = opener();
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(robot.open(kChannel, messages[i]).verdict,
              i < 100 ? Verdict::replayed : Verdict::genuine);
  }
}

TEST_F(Seal, SurvivesKillMinusNineOfTheSender) {
  const auto said = folder_ / "said";
  in_killed_process([&] {
    Sealer base = sealer();
    core::write_file(said, sealed(base, "hold") + sealed(base, "land"));
  });
  const std::string before = core::read_file(said);
  Sealer base = sealer();
  const std::string after = sealed(base, "hold");
  Opener robot = opener();
  for (const std::string& message :
       {before.substr(0, before.size() / 2), before.substr(before.size() / 2), after}) {
    EXPECT_EQ(robot.open(kChannel, message).verdict, Verdict::genuine);
  }
}

TEST_F(Seal, MoreSendersThanTheCeilingAreUnknown) {
  Opener robot = opener();
  int genuine = 0;
  for (int i = 0; i < 80; ++i) {
    Sealer one = sealer(std::to_string(i));
    genuine += robot.open(kChannel, sealed(one, "land")).verdict == Verdict::genuine;
  }
  EXPECT_EQ(genuine, 64);
  EXPECT_EQ(robot.count(Verdict::unknown), 16);
}

TEST_F(Seal, AFolderThatIsNotThereIsRefused) {
  EXPECT_THROW(Sealer(test_key(), "R1", folder_ / "none" / "counter"), Error);
  EXPECT_THROW(Opener(test_key(), "R1", folder_ / "none" / "heard"), Error);
}

TEST_F(Seal, FilesThatAreSomethingElseAreRefused) {
  core::write_file(folder_ / "text", "no counter, no window");
  EXPECT_THROW(Sealer(test_key(), "R1", folder_ / "text"), Error);
  core::write_file(folder_ / "long", std::string(20'000, 'x'));
  EXPECT_THROW(Opener(test_key(), "R1", folder_ / "long"), Error);
  EXPECT_THROW(Sealer(test_key(), "no name", folder_ / "counter"), Error);
}

/// One change of one of the team's messages.
std::string mutated(std::string message, core::Rng& rng) {
  const int at = rng.index(static_cast<int>(message.size()));
  switch (rng.index(5)) {
    case 0:
      message[at] = static_cast<char>(message[at] ^ 1 << rng.index(8));
      return message;
    case 1:
      return message.substr(0, at);
    case 2:
      message.insert(at, 1, static_cast<char>(rng.index(256)));
      return message;
    case 3:
      message.erase(at, 1);
      return message;
    default:
      return some_bytes(rng.index(1200), static_cast<std::uint64_t>(rng.index(1 << 30)));
  }
}

TEST_F(Seal, AHundredThousandMutatedMessagesAreAllDroppedAndCounted) {
  Sealer base = sealer();
  MemoryStore store;
  Exchange robot({}, "R1", test_key(), folder_ / "robot", store);
  robot.add_link(kChannel, Role::calls);
  ChunkMessage chunk;
  chunk.id = {"R2", StreamKind::history, 1};
  chunk.bytes = some_bytes(kChunkBytes, 1);
  core::Rng rng(1);
  int dropped = 0, same = 0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const std::string message = sealed(base, to_bytes(chunk));
    const std::string changed = mutated(message, rng);
    if (changed == message) {  // a byte inserted beside its like, and cut again: no change
      ++same;
      continue;
    }
    dropped += robot.receive(from_seconds(i), kChannel, changed) != Verdict::genuine;
  }
  EXPECT_EQ(dropped + same, kCount);
  EXPECT_TRUE(store.extents().empty());
  long counted = 0;
  for (int v = 1; v < kVerdicts; ++v) counted += robot.opener().count(static_cast<Verdict>(v));
  EXPECT_EQ(counted, dropped);
  EXPECT_EQ(robot.opener().count(Verdict::genuine), 0);
  for (const Verdict v : {Verdict::cut, Verdict::unknown, Verdict::forged}) {
    EXPECT_GT(robot.opener().count(v), 100);
  }
}

}  // namespace
}  // namespace saker::exchange
