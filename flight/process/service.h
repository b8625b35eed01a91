#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace saker::flight {

/// What the service manager is told of this process (sd_notify(3)). All of it does nothing where
/// the process was started by hand. To be called by one thread, none that flies.
class Service {
 public:
  using Steady = std::chrono::steady_clock;

  static constexpr std::chrono::milliseconds kFeedPeriod{500};  ///< of the watchdog, at the fastest

  /// Set up; the watchdog runs from here on.
  void ready() const;
  /// One line for `systemctl status`.
  void say(const std::string& status) const;
  /// Feeds the watchdog: every loop of the process runs. To be called at least twice a second.
  void alive(Steady::time_point now);
  void stopping() const;

 private:
  Steady::time_point fed_ = {};
};

/// Keeps a process that the service manager restarted in the middle of a flight from beginning
/// another: the vehicle stands, or comes down, where no mission begins.
///
/// A file in RUNTIME_DIRECTORY, which outlives an automatic restart but no stop
/// (RuntimeDirectoryPreserve=restart). Without that folder it does nothing.
class FlightMark {
 public:
  /// Throws Error when the flight before this one did not end.
  FlightMark();
  ~FlightMark();  ///< the flight ended, this process with it
  FlightMark(const FlightMark&) = delete;
  FlightMark& operator=(const FlightMark&) = delete;

  /// The flight ended, as the destructor says; for a process that ends without it.
  void clear();

  /// A flight begins. False where it cannot be written down.
  [[nodiscard]] bool set() const;

 private:
  std::filesystem::path file_;  // empty: no service manager
};

/// What the journal takes for a line's priority (sd-daemon(3), "<4>"), for an error; empty where
/// stderr is not the journal.
[[nodiscard]] std::string journal_error();

/// Whether stderr goes to the journal.
[[nodiscard]] bool to_journal();

}  // namespace saker::flight
