#include "flight/ground/session.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace saker::flight::ground
