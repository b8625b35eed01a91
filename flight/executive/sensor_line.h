#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "flight/bus/mailbox.h"
#include "flight/process/configuration.h"
#include "saker/lidar/scan.h"
#include "saker/lidar/sensor_gate.h"
#include "saker/lidar/udp_receiver.h"

/// The sensor's two UDP ports, behind the gate (sensor_gate.h): what passes is given on, the rest
/// is counted and said.
///
/// A turn takes from each port as many datagrams as a hundred sensors would send, and a millisecond
/// at most: a flood costs packets, not the loop. Once the sensor is known the kernel drops what
/// others send, before it costs anything here.
namespace saker::flight {

class SensorLine {
 public:
  using Steady = std::chrono::steady_clock;

  /// A packet that is believed, its stamps corrected.
  struct Packet {
    std::vector<std::uint8_t> payload;
    Steady::time_point arrival;
  };
  using Sink = std::function<void(Packet packet)>;

  struct Figures {
    lidar::GateFigures gate;
    long kernel_drops = 0;  ///< of others, and what found the buffer full
    long cut_turns = 0;     ///< after which a port had more
  };

  /// Throws Error where a port cannot be had, or the sensor's address is none or not to be reached.
  SensorLine(const SensorLineConfig& config, const lidar::SensorInfo& info, double turns_hz);

  /// What has come. To be called by one thread, at `turns_hz`.
  void turn(const Sink& sink);

  /// Of a second ago at most. To be called by any thread.
  [[nodiscard]] std::shared_ptr<const Figures> figures() const { return published_.latest(); }

 private:
  struct Port {
    lidar::UdpReceiver receiver;
    lidar::SensorStream stream;
    int budget;  // datagrams a turn
  };

  void take(Port& port, const Sink& sink);
  void publish(Steady::time_point now);

  lidar::SensorGate gate_;
  std::array<Port, 2> ports_;  // the inertial unit's first: a scan wants the samples before it
  long cut_turns_ = 0;
  Steady::time_point said_;
  Mailbox<Figures> published_;
};

/// The figures for `_HEALTH`: `sensor_refused` first, then its causes, the most frequent first,
/// `most` in all.
[[nodiscard]] std::vector<std::pair<std::string, long>> health_of(
    const SensorLine::Figures& figures, std::size_t most);

/// What the log is told: a sensor that was taken up at once, packets that were refused every five
/// seconds at most. To be called by one thread.
class SensorNews {
 public:
  using Steady = std::chrono::steady_clock;

  /// Lines that are due.
  [[nodiscard]] std::vector<std::string> lines(const SensorLine::Figures& figures,
                                               Steady::time_point now);

 private:
  SensorLine::Figures last_;
  Steady::time_point said_ = {};
};

}  // namespace saker::flight
