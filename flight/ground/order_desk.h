#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "flight/ground/hub.h"
#include "saker/mission_t.hpp"

namespace saker::flight::ground {

/// Takes orders to robots: sealed, sent again until they are acknowledged. One thread.
class OrderLine {
 public:
  using Steady = std::chrono::steady_clock;

  enum class State { sent, acknowledged, refused, silent };
  struct Progress {
    State state = State::silent;
    std::string text;
  };

  virtual ~OrderLine() = default;
  /// Never waits. \return its id
  virtual std::int64_t send(const std::string& robot, const std::string& kind,
                            Steady::time_point now) = 0;
  [[nodiscard]] virtual Progress progress(std::int64_t id) const = 0;
  virtual void hear(const std::string& robot, const mission_t& message) = 0;
  virtual void step(Steady::time_point now) = 0;
};

/// The service `order` (topics.md): people's orders, each answered once it is over, and written
/// down: who, when, what came of it.
class OrderDesk {
 public:
  /// What became of an order, as `/R1/orders` says it.
  using Say = std::function<void(const std::string& robot, const Json& order)>;

  /// \param line  may be null: there is no key of the team, and every order is refused
  /// \param log  lines are added to this file; empty: none
  OrderDesk(std::unique_ptr<OrderLine> line, std::filesystem::path log);

  /// Orders go by this line from now on: one that needs what is made after the desk.
  void send_by(std::unique_ptr<OrderLine> line) { line_ = std::move(line); }

  /// Registers the service; the desk outlives the hub's clients.
  void offer_to(Hub& hub);

  void hear(const std::string& robot, const mission_t& message);
  /// What was asked is sent, what is over is answered. \param t  s, system clock
  void step(double t, OrderLine::Steady::time_point now, const Say& say);

 private:
  struct Wanted {
    std::string robot, kind, by;
    Hub::Reply reply;
  };
  struct Open {
    Wanted wanted;
    std::int64_t id;
    double begun;
  };
  static constexpr std::size_t kMostWaiting = 32;

  void take(const Json& request, const std::string& from, Hub::Reply reply);
  [[nodiscard]] Json order_json(const Open& open, double t,
                                const OrderLine::Progress& progress) const;
  void note(const Json& order);

  std::unique_ptr<OrderLine> line_;
  std::filesystem::path log_;
  std::mutex mutex_;
  std::deque<Wanted> wanted_;
  std::vector<Open> open_;
};

}  // namespace saker::flight::ground
