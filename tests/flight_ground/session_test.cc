#include "flight/ground/session.h"

#include <gtest/gtest.h>

#include <random>

namespace saker::flight::ground {
namespace {

using std::chrono::seconds;

const Session::Steady::time_point kStart{};

Text text(std::size_t size, char c = 'x') { return std::make_shared<const std::string>(size, c); }

SessionLimits small_limits() {
  return {.most_messages = 3, .most_bytes = 100, .most_answer_bytes = 50, .most_wait = seconds(10)};
}

std::string drained(Session& session) {
  std::string bodies;
  while (const auto next = session.take(kStart)) bodies += *next->body;
  return bodies;
}

TEST(Session, GetsMessagesOfItsSubscriptionsAlone) {
  Session session("127.0.0.1", false);
  EXPECT_TRUE(session.subscribe({.id = 4, .channel = 9}));
  session.offer(9, 5, text(2), kStart);
  session.offer(8, 5, text(2), kStart);
  const auto first = session.take(kStart);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->binary);
  EXPECT_EQ(first->head, message_head(4, 5));
  EXPECT_FALSE(session.take(kStart));
}

TEST(Session, AnIdAndAChannelAreSubscribedToOnce) {
  Session session("", false);
  EXPECT_TRUE(session.subscribe({1, 10}));
  EXPECT_FALSE(session.subscribe({1, 11}));
  EXPECT_FALSE(session.subscribe({2, 10}));
  EXPECT_EQ(session.unsubscribe(1), 10u);
  EXPECT_EQ(session.unsubscribe(1), std::nullopt);
  EXPECT_TRUE(session.subscribe({1, 11}));
}

TEST(Session, WhatWaitsOfAChannelGoesWithItsSubscription) {
  Session session("", false);
  session.subscribe({1, 10});
  session.subscribe({2, 11});
  session.offer(10, 0, text(1, 'a'), kStart);
  session.offer(11, 0, text(1, 'b'), kStart);
  session.offer(10, 0, text(1, 'c'), kStart);
  session.unsubscribe(1);
  EXPECT_EQ(drained(session), "b");
}

TEST(Session, OfASlowClientTheOldestOfAChannelIsDropped) {
  Session session("", false, small_limits());
  session.subscribe({1, 10});
  session.subscribe({2, 11});
  session.offer(11, 0, text(1, 'o'), kStart);
  for (const char c : {'a', 'b', 'c', 'd', 'e'}) session.offer(10, 0, text(1, c), kStart);
  EXPECT_EQ(session.dropped(), 2);
  EXPECT_EQ(drained(session), "ocde");
}

TEST(Session, ASlowClientIsToldOnceWhatItMissed) {
  Session session("", false, small_limits());
  session.subscribe({1, 10});
  session.tell_drops(kStart);
  EXPECT_FALSE(session.has_output());
  for (int i = 0; i < 5; ++i) session.offer(10, 0, text(1), kStart);
  session.tell_drops(kStart);
  const auto first = session.take(kStart);
  ASSERT_TRUE(first);
  EXPECT_NE(first->body->find("2 messages were dropped"), std::string::npos);
  session.tell_drops(kStart);
  EXPECT_EQ(drained(session).size(), 3u);
}

TEST(Session, NeverHoldsMoreBytesThanItsCeiling) {
  Session session("", false, small_limits());
  session.subscribe({1, 10});
  for (int i = 0; i < 100; ++i) {
    session.offer(10, 0, text(60), kStart);
    EXPECT_LE(session.waiting_bytes(), 100u);
  }
  EXPECT_EQ(session.dropped(), 99);
}

TEST(Session, AMessageThatIsLargerThanTheCeilingIsStillSaid) {
  Session session("", false, small_limits());
  session.subscribe({1, 10});
  session.offer(10, 0, text(500), kStart);
  EXPECT_EQ(drained(session).size(), 500u);
}

TEST(Session, AnswersComeFirst) {
  Session session("", false);
  session.subscribe({1, 10});
  session.offer(10, 0, text(1, 'm'), kStart);
  session.answer("a", false, kStart);
  EXPECT_EQ(drained(session), "am");
}

TEST(Session, OneThatTakesNothingIsStuckAfterAWhile) {
  Session session("", false, small_limits());
  session.subscribe({1, 10});
  EXPECT_FALSE(session.is_stuck(kStart + seconds(1000)));  // nothing waits
  session.offer(10, 0, text(1), kStart + seconds(1000));
  EXPECT_FALSE(session.is_stuck(kStart + seconds(1009)));
  session.offer(10, 0, text(1), kStart + seconds(1009));
  EXPECT_TRUE(session.is_stuck(kStart + seconds(1011)));
  static_cast<void>(session.take(kStart + seconds(1011)));
  EXPECT_FALSE(session.is_stuck(kStart + seconds(1012)));
}

TEST(Session, OneThatAsksAndNeverTakesTheAnswersIsStuckAtOnce) {
  Session session("", false, small_limits());
  for (int i = 0; i < 6; ++i) session.answer(std::string(10, 'a'), false, kStart);
  EXPECT_TRUE(session.is_stuck(kStart));
}

TEST(Session, MessagesGoOutInTheOrderInWhichTheyCame) {
  Session session("", false);
  session.subscribe({1, 10});
  session.subscribe({2, 11});
  for (const char c : {'a', 'b', 'c', 'd'})
    session.offer(c % 2 == 0 ? 10 : 11, 0, text(1, c), kStart);
  EXPECT_EQ(drained(session), "abcd");
}

TEST(Session, AHeadNamesTheClientsOwnIdAndTheMessagesTime) {
  Session session("", false);
  session.subscribe({7, 10});
  session.offer(10, 123456789, text(1), kStart);
  EXPECT_EQ(session.take(kStart)->head, message_head(7, 123456789));
}

TEST(Session, AnAnswersKindIsThatOfItsFrame) {
  Session session("", false);
  session.answer("{}", false, kStart);
  session.answer("\5", true, kStart);
  EXPECT_FALSE(session.take(kStart)->binary);
  EXPECT_TRUE(session.take(kStart)->binary);
}

TEST(Session, AfterADropOthersOfThatChannelMayWaitAgain) {
  Session session("", false, small_limits());
  session.subscribe({1, 10});
  for (const char c : {'a', 'b', 'c'}) session.offer(10, 0, text(1, c), kStart);
  EXPECT_EQ(*session.take(kStart)->body, "a");
  session.offer(10, 0, text(1, 'd'), kStart);
  EXPECT_EQ(session.dropped(), 0);
  EXPECT_EQ(drained(session), "bcd");
}

TEST(Session, ALargeMessageTakesThePlaceOfTheOldestOfAllChannels) {
  Session session("", false, small_limits());  // 100 bytes
  session.subscribe({1, 10});
  session.subscribe({2, 11});
  session.offer(10, 0, text(40, 'a'), kStart);
  session.offer(11, 0, text(40, 'b'), kStart);
  session.offer(10, 0, text(50, 'c'), kStart);
  EXPECT_EQ(session.dropped(), 1);
  EXPECT_EQ(drained(session), std::string(40, 'b') + std::string(50, 'c'));
}

TEST(Session, IsFullWithMoreAnswersThanMayWaitAndNotAfterTheyWereTaken) {
  Session session("", false, small_limits());  // 50 bytes
  session.answer(std::string(50, 'a'), false, kStart);
  EXPECT_FALSE(session.is_full());
  session.answer("b", false, kStart);
  EXPECT_TRUE(session.is_full());
  drained(session);
  EXPECT_FALSE(session.is_full());
}

TEST(Session, MessagesMakeItNotFull) {
  Session session("", false, small_limits());
  session.subscribe({1, 10});
  session.offer(10, 0, text(90), kStart);
  EXPECT_FALSE(session.is_full());
}

TEST(Session, WaitingBeginsAnewWithEveryThingThatIsTaken) {
  Session session("", false, small_limits());
  session.subscribe({1, 10});
  for (int s = 0; s < 100; s += 9) {
    session.offer(10, 0, text(1), kStart + seconds(s));
    session.offer(10, 0, text(1), kStart + seconds(s));
    EXPECT_FALSE(session.is_stuck(kStart + seconds(s)));
    static_cast<void>(session.take(kStart + seconds(s)));
  }
}

TEST(Session, WhatIsUnsubscribedFreesItsBytes) {
  Session session("", false, small_limits());
  session.subscribe({1, 10});
  session.offer(10, 0, text(60), kStart);
  session.unsubscribe(1);
  EXPECT_EQ(session.waiting_bytes(), 0u);
  EXPECT_FALSE(session.has_output());
  session.subscribe({1, 10});
  session.offer(10, 0, text(3, 'n'), kStart);
  EXPECT_EQ(drained(session), "nnn");
}

/// Whatever is done: the bytes that wait are those of what is then taken, and never over the
/// ceiling.
TEST(Session, CountsWhatWaitsRightly) {
  std::mt19937 random(4);
  for (int round = 0; round < 50; ++round) {
    Session session("", false, small_limits());
    for (int step = 0; step < 60; ++step) {
      const std::uint32_t id = random() % 4;
      switch (random() % 5) {
        case 0:
          session.subscribe({id, id + 10});
          break;
        case 1:
          session.unsubscribe(id);
          break;
        case 2:
          static_cast<void>(session.take(kStart));
          break;
        default:
          session.offer(id + 10, 0, text(1 + random() % 40), kStart);
      }
      EXPECT_LE(session.waiting_bytes(), 100u);
    }
    const std::size_t waiting = session.waiting_bytes();
    EXPECT_EQ(drained(session).size(), waiting);
    EXPECT_EQ(session.waiting_bytes(), 0u);
  }
}

}  // namespace
}  // namespace saker::flight::ground
