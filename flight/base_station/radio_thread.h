#pragma once

#include <atomic>
#include <thread>

#include "flight/bus/bus.h"
#include "flight/bus/mailbox.h"
#include "flight/link/radio.h"
#include "flight/process/configuration.h"

namespace saker::flight {

/// The ground's end of the link on a thread of its own, with an ear of its own on this machine's
/// LCM: an order, or a robot's session, waits for no disk. What robots say reaches the station by
/// LCM; what LCM's queue of a channel does not hold while a disk takes its time is lost, and asked
/// for again (exchange/peer.h).
class RadioThread {
 public:
  using Steady = LinkEnd::Steady;

  /// \param name  under which this machine seals: BASE
  /// Throws Error where the port is taken, and as Bus and LinkEnd do.
  RadioThread(const ProcessConfig& config, const std::string& name);
  ~RadioThread() = default;  ///< says goodbye to every robot, and ends
  RadioThread(const RadioThread&) = delete;
  RadioThread& operator=(const RadioThread&) = delete;

  // Any thread.

  /// As of its last turn.
  [[nodiscard]] LinkEnd::Report report() const;
  /// Throws Error where its LCM network is gone. \return whether it had a turn of late
  [[nodiscard]] bool runs(Steady::time_point now) const;

 private:
  void run(const std::stop_token& stop);

  Bus bus_;
  Radio radio_;
  ValueBox<LinkEnd::Report> report_;
  std::atomic<Steady::time_point> turned_;
  std::atomic<bool> failed_ = false;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace saker::flight
