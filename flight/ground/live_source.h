#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "flight/bus/bus.h"
#include "flight/ground/order_desk.h"
#include "flight/ground/publisher.h"

namespace saker::flight::ground {

/// What robots say on the bus, for the hub. It only listens: nothing but orders goes out. The bulk
/// network is joined while somebody wants what is on it. One thread.
class LiveSource {
 public:
  static constexpr double kLost_s = 1.5;  ///< of silence: the link is lost

  /// Subscribes at once. Throws Error as Bus does. \param recording  may be null
  LiveSource(const BusConfig& config, const std::string& name,
             std::shared_ptr<const viewers::Site> site, Hub& hub, OrderDesk& orders,
             viewers::Recording* recording);

  /// Waits until it is due, hears what has come, says what is due.
  void step();

  [[nodiscard]] Bus& bus() { return control_; }
  [[nodiscard]] const viewers::RobotViews& views() const { return views_; }

 private:
  void subscribe();
  void join_bulk();

  BusConfig config_;
  std::string name_;
  Bus control_;
  std::optional<Bus> bulk_;
  bool bulk_failed_ = false;
  viewers::RobotViews views_;
  Publisher publisher_;
  OrderDesk& orders_;
  std::chrono::steady_clock::time_point next_{};
};

/// s, the system clock.
[[nodiscard]] double system_seconds();

}  // namespace saker::flight::ground
