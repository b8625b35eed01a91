#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "flight/base_station/store.h"
#include "flight/bus/bus.h"
#include "flight/link/link_end.h"
#include "flight/process/configuration.h"
#include "flight/process/loop_meter.h"
#include "saker/exchange/exchange.h"

namespace saker::flight {

/// How the ground's end of the link stands; asked for once a second.
using LinkReports = std::function<LinkEnd::Report()>;

/// The base station on its machine's LCM, where the ground's end of the link (flight/link) says
/// what robots say: exchanges histories with every robot that has a key of the team, keeps them,
/// says `_HEALTH` at 1 Hz.
///
/// One thread, which waits for the disk: handlers pass what comes to the exchange, `step` sends
/// what is due. Nothing that a robot is ordered passes here (radio_thread.h).
class BaseStation {
 public:
  using Steady = std::chrono::steady_clock;

  /// Subscribes to the bus, which has to outlive this as `store` does.
  /// \param link  for HEALTH; empty: none
  /// Throws Error on an invalid value.
  BaseStation(const ProcessConfig& config, DatabaseStore& store, Bus& bus, LinkReports link);

  void step(Steady::time_point now);

  /// What was sent and received since the start, in one line of the log.
  void say_totals() const;

  /// Until when there is nothing to do, unless something is heard.
  [[nodiscard]] Steady::time_point next_due() const;

 private:
  /// A robot as it was last looked at.
  struct Visit {
    bool in_contact = false;
    bool all_sent = false;
    Time heard = 0;
  };

  bool hear(const std::string& robot, const exchange_t& message);
  [[nodiscard]] bool admit(const std::string& channel, const exchange_t& message);
  void warn_of_earlier(const std::string& robot);
  void warn_of_full(const std::string& robot);
  void send(Time now);
  void look_at_contacts(Time now);
  void say_health();

  BaseConfig config_;
  DatabaseStore& store_;
  Bus& bus_;
  LinkReports link_;
  exchange::Exchange exchange_;
  std::map<std::string, Visit> visits_;  // by channel
  std::set<std::string> warned_;         // of robots that were heard with an earlier epoch
  long not_sent_ = 0, crowded_ = 0;
  LoopMeter meter_{"base"};
  Steady::time_point next_step_{}, next_look_{}, next_health_{};
};

}  // namespace saker::flight
