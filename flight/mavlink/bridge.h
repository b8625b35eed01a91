#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "flight/mavlink/authority.h"
#include "flight/mavlink/clocks.h"
#include "flight/mavlink/commands.h"
#include "flight/mavlink/config.h"
#include "flight/mavlink/frame.h"
#include "flight/mavlink/mounting.h"
#include "flight/mavlink/odometry_out.h"
#include "flight/mavlink/setpoint_out.h"
#include "flight/mavlink/state_in.h"
#include "saker/core/vehicle.h"

/// The executive's interface ↔ one autopilot's MAVLink.
///
/// Reads bytes of the line, odometry, setpoints and orders, each with the host's time at which it
/// came; makes bytes for the line, answers to orders and the vehicle's state. No socket, no clock,
/// no bus: the process (mavlink_process.h) has those, and a test may have any others. Nothing
/// throws after the constructor. Call `step` at least 100 times a second.
namespace saker::flight::mavlink {

class Bridge {
 public:
  struct Counters {
    long odometry = 0, setpoints = 0, commands = 0;  ///< sent
    long not_finite = 0;                             ///< messages that were not sent for it
    long overflow = 0;                               ///< frames that nobody took out
    long losses = 0;                                 ///< of odometry in flight: LAND was commanded
  };

  /// Throws Error on an invalid value.
  /// \param key  not nothing: everything is signed, both ways
  explicit Bridge(const BridgeConfig& config, const std::optional<SigningKey>& key = {});

  void hear_bytes(std::span<const std::uint8_t> bytes, Time now, SigningTime signing_now);
  /// The end of a datagram, or a pause of the line.
  void settle(Time now, SigningTime signing_now);
  /// \param fresh  it did not lie anywhere before: only such goes on
  void hear(const VehicleOdometry& odometry, Time now, bool fresh = true);
  void hear(const Setpoint& setpoint, Time now);
  void hear(const Command& command, Time now);

  /// Does what is due.
  void step(Time now, SigningTime signing_now);

  [[nodiscard]] std::vector<FrameBytes> take_frames() { return std::exchange(frames_, {}); }
  [[nodiscard]] std::vector<saker::CommandAck> take_answers(Time now);
  /// Nothing before the autopilot speaks, and while it is silent.
  [[nodiscard]] std::optional<VehicleState> vehicle_state(Time now) const;

  [[nodiscard]] const StateIn& autopilot() const { return state_; }
  [[nodiscard]] const Authority& authority() const { return authority_; }
  [[nodiscard]] const OdometryOut& odometry() const { return odometry_; }
  [[nodiscard]] const SetpointOut& setpoints() const { return setpoints_; }
  [[nodiscard]] const TimeSync& time_sync() const { return time_sync_; }
  [[nodiscard]] const FrameReader& reader() const { return reader_; }
  [[nodiscard]] const Counters& counters() const { return counters_; }
  /// Why it does not fly as the executive wants; empty: it does.
  [[nodiscard]] const std::string& cause() const { return cause_; }

 private:
  /// What is due again and again, never made up for.
  struct Timer {
    Time period;
    Time next = 0;
    bool due(Time now);
    /// Whether something new may go before its time; the timer then waits for the one after it.
    bool early(Time now);
  };

  template <class Message>
  void send(const Message& message);
  void read(Time now, SigningTime signing_now);
  void hear(const Frame& frame, Time now);
  void hear_autopilot(const Frame& frame, Time now);
  void ask_for_messages();
  void send_orders(Time now);
  void send_setpoint(Time now);
  void watch(Time now);
  void land(Time now, const std::string& cause);
  void begin_own(const ModeNumber& mode, Time now);
  void give_back();
  void finish_takeoff(const saker::CommandAck& answer, Time now);
  [[nodiscard]] bool flying() const;
  [[nodiscard]] bool guided() const;
  [[nodiscard]] bool streams_before_guided() const;
  [[nodiscard]] bool may_move(Time now) const;
  [[nodiscard]] Place here() const;
  [[nodiscard]] VehicleMode mode(Time now) const;
  [[nodiscard]] Time sensor_time(Time now) const;

  BridgeConfig config_;
  Dialect dialect_;
  Mounting mounting_;  // odometry and setpoints are the autopilot's from here on
  std::optional<Signing> signing_;
  FrameReader reader_;
  FrameWriter writer_;
  StateIn state_;
  Authority authority_;
  Commander commander_;
  OdometryOut odometry_;
  SetpointOut setpoints_;
  TimeSync time_sync_;
  Timer heartbeat_{kNanosecondsPerSecond}, ask_{5 * kNanosecondsPerSecond},
      origin_{kNanosecondsPerSecond}, setpoint_{kNanosecondsPerSecond / 50};
  // Since the last step, which sends it: what the line says of a pilot is read before.
  bool setpoint_heard_ = false;
  std::vector<FrameBytes> frames_;
  std::vector<saker::CommandAck> direct_answers_;  // to orders that the commander does not have
  std::optional<Command> takeoff_;                 // by setpoints, waiting for the mode
  bool takeoff_begun_ = false;
  std::optional<saker::CommandAck>
      takeoff_answer_;                     // to the last one, told again where it is asked again
  std::optional<Time> stream_since_;       // setpoints go out before the mode
  std::int64_t resume_ = 0, resumed_ = 0;  // ids of orders to give the vehicle back; 0: none
  std::int64_t own_id_ = 0;                // of our own orders, below zero
  std::optional<std::uint32_t> own_mode_;  // the last that we asked for by ourselves …
  Time own_again_ = 0;                     // … and may again
  std::string cause_;
  SigningTime signing_now_ = 0;
  Counters counters_;
};

}  // namespace saker::flight::mavlink
