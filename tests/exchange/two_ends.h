#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "lossy_link.h"
#include "saker/exchange/exchange.h"
#include "saker/exchange/journal_store.h"

namespace saker::exchange {

/// A folder of this test's own, empty.
inline std::filesystem::path test_folder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "saker-exchange" /
                                       (std::string(test->test_suite_name()) + test->name());
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline Key test_key() {
  Key key{};
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::uint8_t>(7 * i + 1);
  return key;
}

/// Bytes that do not repeat.
inline std::string some_bytes(std::size_t count, std::uint64_t seed) {
  core::Rng rng(seed);
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(rng.index(256));
  return bytes;
}

/// One process: what it has in memory ends with `kill`, what is in its folder stays.
class End {
 public:
  End(const PeerConfig& config, std::string name, Role role, std::filesystem::path folder)
      : config_(config), name_(std::move(name)), role_(role), folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    start();
  }

  void kill_and_start() {
    sent_bytes_ += exchange_->counters().sent_bytes;
    chunks_sent_ += exchange_->counters().peers.chunks_sent;
    chunks_repeated_ += exchange_->counters().peers.chunks_repeated;
    exchange_.reset();
    store_.reset();
    start();
  }

  [[nodiscard]] Store& store() { return *store_; }
  [[nodiscard]] Exchange& exchange() { return *exchange_; }
  [[nodiscard]] bool all_sent(Time now) const { return exchange_->contacts(now).front().all_sent; }

  // In all lives.
  [[nodiscard]] long sent_bytes() const { return sent_bytes_ + exchange_->counters().sent_bytes; }
  [[nodiscard]] long chunks_sent() const {
    return chunks_sent_ + exchange_->counters().peers.chunks_sent;
  }
  [[nodiscard]] long chunks_repeated() const {
    return chunks_repeated_ + exchange_->counters().peers.chunks_repeated;
  }

 private:
  void start() {
    store_ = std::make_unique<JournalStore>(folder_ / "streams.journal");
    exchange_ = std::make_unique<Exchange>(config_, name_, test_key(), folder_, *store_);
    exchange_->add_link("R1_EXCHANGE", role_);
  }

  PeerConfig config_;
  std::string name_;
  Role role_;
  std::filesystem::path folder_;
  std::unique_ptr<JournalStore> store_;
  std::unique_ptr<Exchange> exchange_;
  long sent_bytes_ = 0, chunks_sent_ = 0, chunks_repeated_ = 0;
};

/// A robot and its base with a link each way, in steps of 10 ms.
class TwoEnds {
 public:
  TwoEnds(const std::filesystem::path& folder, const LossConfig& loss, std::uint64_t seed,
          const PeerConfig& config = {})
      : robot(config, "R1", Role::calls, folder / "robot"),
        base(config, "BASE", Role::answers, folder / "base"),
        to_base(loss, core::Rng(seed).fork(0)),
        to_robot(loss, core::Rng(seed).fork(1)) {}

  void step() {
    now += from_seconds(0.01);
    hear(base, to_base);
    hear(robot, to_robot);
    say(robot, to_base);
    say(base, to_robot);
  }

  /// Whether both ends hold the same, and both know it.
  [[nodiscard]] bool equal() {
    return robot.all_sent(now) && base.all_sent(now) &&
           robot.store().extents() == base.store().extents();
  }

  /// Steps until both ends hold the same; how long it took, s.
  double run(double most_s) {
    const Time begin = now;
    do {
      step();
    } while (!equal() && now - begin < from_seconds(most_s));
    return to_seconds(now - begin);
  }

  End robot, base;
  LossyLink to_base, to_robot;
  Time now = from_seconds(1000);
  bool in_reach = true;

 private:
  void hear(End& end, LossyLink& link) {
    while (const auto datagram = link.receive(now)) {
      if (in_reach) end.exchange().receive(now, "R1_EXCHANGE", *datagram);
    }
  }
  void say(End& end, LossyLink& link) {
    while (const auto datagram = end.exchange().next(now)) {
      EXPECT_LE(datagram->bytes.size(), kLongestDatagram);
      link.send(now, datagram->bytes);
    }
  }
};

}  // namespace saker::exchange
