#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "flight/mavlink/frame.h"
#include "tools/sim/mavlink/craft.h"
#include "tools/sim/mavlink/estimator.h"
#include "tools/sim/mavlink/guided.h"
#include "tools/sim/mavlink/parameters.h"
#include "tools/sim/mavlink/quirks.h"
#include "tools/sim/mavlink/streams.h"

/// An autopilot's side of MAVLink over any vehicle: modes, arming and its refusals, take-off and
/// landing, setpoints, odometry, time-outs, acknowledgements and streams.
///
/// Reads bytes of the line and the state of the inner loops (`CraftState`); makes bytes and orders
/// for the inner loops. It knows of no odometry but ODOMETRY. Times are the vehicle's clock; no
/// socket, no clock of its own. Sources: the table of quirks (quirks.h). Left out: missions,
/// signing, and that ArduPilot keeps its heading when that of our odometry is reset.
namespace saker::tools {

class SimulatedAutopilot {
 public:
  static constexpr std::uint8_t kSystem = 1, kComponent = 1;

  SimulatedAutopilot(Quirks quirks, Time boot)
      : quirks_(std::move(quirks)), boot_(boot), mode_(first_mode(quirks_)) {}
  SimulatedAutopilot(const SimulatedAutopilot&) = delete;
  SimulatedAutopilot& operator=(const SimulatedAutopilot&) = delete;

  void hear_bytes(std::span<const std::uint8_t> bytes, Time vehicle_now);
  /// At least 100 times a second.
  void step(Time vehicle_now, const CraftState& craft);
  [[nodiscard]] std::vector<flight::mavlink::FrameBytes> take_frames() {
    return std::exchange(frames_, {});
  }
  [[nodiscard]] CraftOrders take_orders() { return std::exchange(orders_, {}); }

  /// A pilot's switch, or a failsafe that this model does not have.
  void switch_mode(std::uint32_t custom_mode, bool critical = false);
  /// Says something.
  void text(int severity, const std::string& words);

  [[nodiscard]] bool armed() const { return armed_; }
  [[nodiscard]] std::uint32_t mode() const { return mode_; }
  [[nodiscard]] flight::mavlink::Landed landed() const { return landed_; }
  /// Take-offs that a setpoint ended.
  [[nodiscard]] int cancelled() const { return cancelled_; }
  [[nodiscard]] const EstimatorModel& estimator() const { return estimator_; }
  /// It died of a NaN and says nothing any more.
  [[nodiscard]] bool dead() const { return dead_; }

 private:
  enum class Climb { none, spooling, climbing, reached };

  [[nodiscard]] static std::uint32_t first_mode(const Quirks& quirks);
  template <class Message>
  void say(const Message& message);
  void say(std::uint32_t id);
  void say_heartbeat();
  void say_battery(std::uint32_t id);
  void say_motion(std::uint32_t id);
  template <class Message>
  [[nodiscard]] Message with_turning(Message message) const;
  void hear(const flight::mavlink::Frame& frame);
  void hear(const flight::mavlink::SetPositionTargetLocalNed& target);
  void hear_origin(const flight::mavlink::SetGpsGlobalOrigin& origin);
  void hear_parameters(const flight::mavlink::Frame& frame);
  AckResult obey(const flight::mavlink::CommandLong& command);
  AckResult request_mode(std::uint32_t custom_mode);
  AckResult arm();
  AckResult disarm_ordered();
  AckResult take_off(double height_m);
  AckResult set_interval(std::uint32_t id, double interval_us);
  [[nodiscard]] std::vector<std::string> arming_refusals() const;

  void enter(std::uint32_t custom_mode);
  void disarm();
  void order(CommandKind kind, double height_m = NAN);
  void fail_safe(int severity, const std::string& words);
  void watch();
  void climb();
  void climb_by_setpoints();
  void follow_landing();
  void follow_setpoints();
  [[nodiscard]] bool flying() const { return landed_ != flight::mavlink::Landed::on_ground; }
  [[nodiscard]] bool guided() const { return mode_ == quirks_.dialect.guided.custom; }
  [[nodiscard]] bool landing() const { return mode_ == quirks_.dialect.land.custom; }
  [[nodiscard]] double since(Time time) const { return to_seconds(now_ - time); }
  [[nodiscard]] double height() const { return craft_.T_odom_body.translation().z(); }

  Quirks quirks_;
  Time boot_;
  std::uint32_t mode_;
  EstimatorModel estimator_{quirks_};
  Guided guided_{quirks_};
  Streams streams_{quirks_};
  AutopilotParameters parameters_{quirks_.dialect.autopilot};
  flight::mavlink::FrameReader reader_;
  flight::mavlink::FrameWriter writer_{kSystem, kComponent};
  std::vector<flight::mavlink::FrameBytes> frames_;
  CraftOrders orders_;
  CraftState craft_;
  flight::mavlink::SetGpsGlobalOrigin origin_;

  // Times are since boot.
  Time now_ = 0;
  bool armed_ = false, critical_ = false, dead_ = false;
  flight::mavlink::Landed landed_ = flight::mavlink::Landed::on_ground;
  Climb climb_ = Climb::none;
  Time mode_at_ = 0, armed_at_ = 0, climb_at_ = 0, reached_at_ = 0;
  double climb_height_ = 0, climb_to_ = 0;  // above the ground; z in `odom`
  std::optional<Time> descends_at_;         // of a landing that has not begun to descend
  std::optional<Time> touched_at_;
  std::optional<Time> ground_station_at_;
  std::int64_t last_order_ = 0;
  int cancelled_ = 0;
};

}  // namespace saker::tools
