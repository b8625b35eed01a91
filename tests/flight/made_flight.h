#pragma once

#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "flight/mavlink/codec.h"
#include "flight/mavlink/odometry_out.h"
#include "made_craft.h"
#include "tools/sim/mavlink/autopilot.h"

namespace saker::tools {

/// The autopilot over a made craft, since its boot and in made time, and a script in the place of
/// a bridge: odometry at 40 Hz, setpoints at 50 Hz, commands. What it says is written down.
class MadeFlight {
 public:
  struct Event {
    double t;  ///< s since boot
    std::string what;
  };

  explicit MadeFlight(const Quirks& quirks) : autopilot(quirks, 0), quirks_(quirks) {
    ask(flight::mavlink::Heartbeat::kId, 10);
    ask(flight::mavlink::ExtendedSysState::kId, 10);
    ask(quirks.dialect.estimator_message, 10);
  }

  void run_to(double seconds) {
    for (const Time end = from_seconds(seconds); now < end;) {
      now += 5'000'000;
      if (odometry) say_odometry();
      if (target && now % 20'000'000 == 0) say_target();
      if (heartbeats && now % kNanosecondsPerSecond == 0) send(heartbeat(), *heartbeats);
      craft.step(0.005);
      autopilot.step(now, craft.state());
      craft.obey(autopilot.take_orders());
      hear();
    }
  }

  void command(std::uint16_t number, const std::array<float, 7>& p) {
    flight::mavlink::CommandLong m;
    m.command = number;
    m.target_system = 1;
    m.target_component = 1;
    m.param1 = p[0];
    m.param2 = p[1];
    m.param3 = p[2];
    m.param4 = p[3];
    m.param5 = p[4];
    m.param6 = p[5];
    m.param7 = p[6];
    send(m);
    hear();
  }

  template <class Message>
  void send(const Message& message, int system = 254) {
    flight::mavlink::FrameWriter writer(static_cast<std::uint8_t>(system), 191);
    const auto frame = writer.write(message);
    if (frame) autopilot.hear_bytes(frame->span(), now);
  }

  /// A target whose x is no number: the bridge's own encoder refuses it.
  void send_nan() {
    using flight::mavlink::SetPositionTargetLocalNed;
    auto frame = *flight::mavlink::FrameWriter(254, 191).write(to(1, -3));
    constexpr std::size_t kX = 10 + 4;  // header, time_boot_ms
    const float nan = NAN;
    std::memcpy(frame.bytes.data() + kX, &nan, sizeof nan);
    const std::uint8_t extra = SetPositionTargetLocalNed::kCrcExtra;
    const std::uint16_t crc = flight::mavlink::crc16(
        {&extra, 1}, flight::mavlink::crc16(frame.span().subspan(1, frame.length - 3)));
    frame.bytes[frame.length - 2] = static_cast<std::uint8_t>(crc);
    frame.bytes[frame.length - 1] = static_cast<std::uint8_t>(crc >> 8);
    autopilot.hear_bytes(frame.span(), now);
  }

  void send_origin() {
    send(flight::mavlink::SetGpsGlobalOrigin{.latitude = 1, .target_system = 1});
  }

  /// With a place, a velocity and an acceleration of nothing, in NED.
  static flight::mavlink::SetPositionTargetLocalNed to(double x, double z, double vx = 0) {
    flight::mavlink::SetPositionTargetLocalNed m;
    m.x = static_cast<float>(x);
    m.z = static_cast<float>(z);
    m.vx = static_cast<float>(vx);
    m.type_mask = 0x800;
    m.coordinate_frame = 1;
    m.target_system = 1;
    return m;
  }

  /// Armed, in the air at 3 m, 17 s after boot: for tests that begin in the air.
  void take_off() {
    run_to(8);
    send_origin();
    run_to(9);
    if (quirks_.dialect.own_takeoff) command(176, {1, 4});
    command(400, {1});
    if (quirks_.dialect.own_takeoff) {
      command(22, {0, 0, 0, 0, 0, 0, 3});
    } else {
      target = to(0, -3);
      run_to(9.2);
      command(176, {1, 6});
    }
    run_to(18);
  }

  [[nodiscard]] bool said(const std::string& what) const {
    for (const Event& event : events)
      if (event.what == what) return true;
    return false;
  }

  Time now = 0;
  SimulatedAutopilot autopilot;
  MadeCraft craft;
  bool odometry = true;
  int quality = 100, reset_counter = 0;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< of `odom`
  std::optional<int> heartbeats;                     ///< of this system
  std::optional<flight::mavlink::SetPositionTargetLocalNed> target;
  std::vector<Event> events;
  std::uint16_t flags = 0;
  int frames = 0;

 private:
  static flight::mavlink::Heartbeat heartbeat() { return {.type = 18, .autopilot = 8}; }

  void ask(std::uint32_t id, float hz) {
    command(511, {static_cast<float>(id), 1e6F / hz});
    events.clear();
  }

  void say_target() {
    target->x += 0.02F * target->vx;
    send(*target);
  }

  void say_odometry() {
    VehicleOdometry o;
    o.stamp = now;
    o.T_odom_body.translation() = craft.place() + offset;
    o.velocity = craft.velocity();
    o.angular_velocity.setZero();
    o.covariance = Matrix6d::Identity() * 1e-4;
    o.status = VehicleOdometryStatus::ok;
    o.reset_counter = reset_counter;
    auto message = out_.hear(o, now).message;
    if (!message) return;
    message->quality = static_cast<std::int8_t>(quality);
    send(*message);
  }

  void note(const std::string& what) { events.push_back({to_seconds(now), what}); }

  void hear() {
    using namespace flight::mavlink;
    for (const FrameBytes& bytes : autopilot.take_frames()) {
      reader_.push(bytes.span());
      while (const auto frame = reader_.next()) hear(*frame);
    }
  }

  void hear(const flight::mavlink::Frame& frame) {
    using namespace flight::mavlink;
    ++frames;
    if (frame.id == Heartbeat::kId) hear(decode<Heartbeat>(frame.bytes()));
    if (frame.id == EkfStatusReport::kId) flags = decode<EkfStatusReport>(frame.bytes()).flags;
    if (frame.id == flight::mavlink::CommandAck::kId) {
      const auto ack = decode<flight::mavlink::CommandAck>(frame.bytes());
      note("ACK " + std::to_string(ack.command) + " " + std::to_string(ack.result));
    }
    if (frame.id == Statustext::kId)
      note("TEXT " + text_of(decode<Statustext>(frame.bytes()).text));
    if (frame.id == ExtendedSysState::kId) {
      const int landed = decode<ExtendedSysState>(frame.bytes()).landed_state;
      if (landed != landed_) note("LANDED_STATE " + std::to_string(landed));
      landed_ = landed;
    }
  }

  void hear(const flight::mavlink::Heartbeat& message) {
    const bool armed = (message.base_mode & flight::mavlink::kArmedFlag) != 0;
    if (message.custom_mode != mode_) note("MODE " + std::to_string(message.custom_mode));
    if (armed != armed_) note(armed ? "ARMED" : "DISARMED");
    mode_ = message.custom_mode;
    armed_ = armed;
  }

  Quirks quirks_;
  flight::mavlink::OdometryOut out_;
  flight::mavlink::FrameReader reader_;
  std::uint32_t mode_ = 0;
  bool armed_ = false;
  int landed_ = 1;
};

}  // namespace saker::tools
