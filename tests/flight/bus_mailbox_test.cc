#include <gtest/gtest.h>

#include <thread>

#include "flight/bus/mailbox.h"

namespace saker::flight {
namespace {

TEST(Mailbox, IsEmptyBeforeTheFirstValue) {
  Mailbox<int> box;
  EXPECT_EQ(box.latest(), nullptr);
  EXPECT_EQ(box.take(), nullptr);
}

TEST(Mailbox, HoldsTheNewestValue) {
  Mailbox<int> box;
  box.put(1);
  box.put(2);
  EXPECT_EQ(*box.latest(), 2);
}

TEST(Mailbox, IsTakenOnceAndReadOften) {
  Mailbox<int> box;
  box.put(7);
  EXPECT_EQ(*box.take(), 7);
  EXPECT_EQ(box.take(), nullptr);
  EXPECT_EQ(*box.latest(), 7);
}

TEST(Mailbox, SharesItsValueWithoutACopy) {
  Mailbox<std::vector<int>> box;
  const auto value = std::make_shared<const std::vector<int>>(1000, 3);
  box.put(value);
  EXPECT_EQ(box.latest().get(), value.get());
}

TEST(Mailbox, LetsGoOfAnOldValue) {
  Mailbox<int> box;
  auto value = std::make_shared<const int>(1);
  const std::weak_ptr<const int> watched = value;
  box.put(std::move(value));
  box.put(2);
  EXPECT_TRUE(watched.expired());
}

TEST(ValueBox, HoldsACopyOfTheNewestValueUntilItIsCleared) {
  ValueBox<int> box;
  EXPECT_EQ(box.latest(), std::nullopt);
  box.put(1);
  box.put(2);
  EXPECT_EQ(box.latest(), 2);
  EXPECT_EQ(box.latest(), 2);
  box.clear();
  EXPECT_EQ(box.latest(), std::nullopt);
}

TEST(BoundedQueue, GrowsToItsCapacityInTheOrderOfItsValues) {
  BoundedQueue<int> queue(300);
  for (int value = 0; value < 40; ++value) queue.push(value);
  for (int value = 0; value < 30; ++value) EXPECT_EQ(queue.pop(), value);  // it goes around
  for (int value = 40; value < 400; ++value) queue.push(value);
  const std::vector<int> values = queue.take_all();
  ASSERT_EQ(values.size(), 300u);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], static_cast<int>(i) + 100);
  EXPECT_EQ(queue.dropped(), 70);
}

TEST(BoundedQueue, GivesValuesInTheirOrder) {
  BoundedQueue<int> queue(3);
  for (const int value : {1, 2, 3}) queue.push(value);
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.take_all(), (std::vector<int>{2, 3}));
  EXPECT_EQ(queue.pop(), std::nullopt);
  EXPECT_EQ(queue.dropped(), 0);
}

TEST(BoundedQueue, DropsTheOldestAndCountsIt) {
  BoundedQueue<int> queue(2);
  for (int value = 0; value < 10; ++value) queue.push(value);
  EXPECT_EQ(queue.size(), 2u);
  EXPECT_EQ(queue.dropped(), 8);
  EXPECT_EQ(queue.take_all(), (std::vector<int>{8, 9}));
}

TEST(BoundedQueue, LosesNothingButWhatItCountsBetweenTwoThreads) {
  constexpr int kValues = 20000;
  BoundedQueue<int> queue(64);
  long taken = 0;
  int last = -1;
  bool ascending = true;
  const auto take = [&] {
    for (const int value : queue.take_all()) {
      ascending = ascending && value > last;
      last = value;
      ++taken;
    }
  };
  std::thread writer([&] {
    for (int value = 0; value < kValues; ++value) queue.push(value);
  });
  while (last < kValues - 1) take();
  writer.join();
  EXPECT_TRUE(ascending);
  EXPECT_EQ(taken + queue.dropped(), kValues);
}

}  // namespace
}  // namespace saker::flight
