#include "flight/executive/sensor_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

using lidar::GateCause;
using lidar::SensorStream;

constexpr double kFlood = 128;  // times the sensor's rate are read and judged
constexpr int kLeastBudget = 64;
constexpr std::chrono::milliseconds kMostTime{1};  // of a turn, for each port
constexpr int kLookEvery = 16;                     // packets; at the clock
constexpr double kImuPackets_hz = 100;
constexpr std::chrono::seconds kPublishPeriod{1};
constexpr std::chrono::seconds kNewsPeriod{5};

std::optional<std::uint32_t> address_of(const SensorLineConfig& config) {
  if (config.address.empty()) return std::nullopt;
  const auto address = lidar::parse_address(config.address);
  if (address && *address != 0) return address;
  throw Error("sensor.address: " + config.address + ", expected an address as in 192.168.7.2");
}

int budget_of(double rate_hz, double turns_hz) {
  return std::max(kLeastBudget, static_cast<int>(std::ceil(kFlood * rate_hz / turns_hz)));
}

double lidar_packets_hz(const lidar::SensorInfo& info) {
  return info.frame_rate_hz * info.columns / info.columns_per_packet;
}

Time nanoseconds(SensorLine::Steady::time_point time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

const char* short_name(GateCause cause) {
  switch (cause) {
    case GateCause::none:
      return "sensor_passed";
    case GateCause::waits:
      return "sensor_waits";
    case GateCause::not_agreed:
      return "sensor_not_agreed";
    case GateCause::shape:
      return "sensor_shape";
    case GateCause::address:
      return "sensor_address";
    case GateCause::port:
      return "sensor_port";
    case GateCause::serial_number:
      return "sensor_serial";
    case GateCause::restarted:
      return "sensor_restarted";
    case GateCause::stamp:
      return "sensor_stamp";
    case GateCause::ahead:
      return "sensor_ahead";
    case GateCause::late:
      return "sensor_late";
    case GateCause::back:
      return "sensor_back";
    case GateCause::frame:
      return "sensor_frame";
    case GateCause::columns:
      return "sensor_columns";
    case GateCause::out_of_order:
      return "sensor_out_of_order";
    case GateCause::too_many:
      return "sensor_too_many";
  }
  return "";
}

}  // namespace

SensorLine::SensorLine(const SensorLineConfig& config, const lidar::SensorInfo& info,
                       double turns_hz)
    : gate_(info, {address_of(config), {}}),
      ports_{Port{lidar::UdpReceiver(info.imu_port), SensorStream::imu,
                  budget_of(kImuPackets_hz, turns_hz)},
             Port{lidar::UdpReceiver(info.lidar_port), SensorStream::lidar,
                  budget_of(lidar_packets_hz(info), turns_hz)}} {
  const auto address = address_of(config);
  if (!address) return;
  for (Port& port : ports_) port.receiver.bind_to_interface_of(*address);
}

void SensorLine::turn(const Sink& sink) {
  const Steady::time_point now = Steady::now();
  for (Port& port : ports_) {
    (void)port.receiver.hear_only(gate_.source(port.stream, nanoseconds(now)));
    take(port, sink);
  }
  publish(now);
}

void SensorLine::take(Port& port, const Sink& sink) {
  const Steady::time_point end = Steady::now() + kMostTime;
  for (int taken = 0; taken < port.budget; ++taken) {
    if (taken % kLookEvery == kLookEvery - 1 && Steady::now() > end) break;
    const auto datagram = port.receiver.take();
    if (!datagram) return;
    gate_.pass(datagram->payload, datagram->source, nanoseconds(datagram->arrival),
               [&sink](std::vector<std::uint8_t> payload, Time arrival) {
                 sink({std::move(payload), Steady::time_point(std::chrono::nanoseconds(arrival))});
               });
  }
  ++cut_turns_;
}

void SensorLine::publish(Steady::time_point now) {
  if (now - said_ < kPublishPeriod) return;
  said_ = now;
  Figures figures{gate_.figures(), 0, cut_turns_};
  for (const Port& port : ports_) figures.kernel_drops += port.receiver.kernel_drops();
  published_.put(std::move(figures));
}

std::vector<std::pair<std::string, long>> health_of(const SensorLine::Figures& figures,
                                                    std::size_t most) {
  std::vector<std::pair<std::string, long>> causes;
  long refused = figures.kernel_drops;
  for (int i = 1; i < lidar::kGateCauses; ++i) {
    const long count = figures.gate.refused[static_cast<std::size_t>(i)];
    refused += count;
    if (count > 0) causes.emplace_back(short_name(static_cast<GateCause>(i)), count);
  }
  if (figures.kernel_drops > 0) causes.emplace_back("sensor_kernel_drops", figures.kernel_drops);
  std::ranges::stable_sort(causes, std::ranges::greater{}, [](const auto& c) { return c.second; });
  causes.insert(causes.begin(), {"sensor_refused", refused});
  causes.resize(std::min(causes.size(), most));
  return causes;
}

std::vector<std::string> SensorNews::lines(const SensorLine::Figures& figures,
                                           Steady::time_point now) {
  std::vector<std::string> lines;
  if (figures.gate.agreements != last_.gate.agreements) {
    lines.push_back("sensor: " + figures.gate.last_agreement);
    last_.gate.agreements = figures.gate.agreements;
  }
  if (now - said_ < kNewsPeriod) return lines;
  for (int i = 1; i < lidar::kGateCauses; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const long count = figures.gate.refused[at] - last_.gate.refused[at];
    if (count <= 0) continue;  // less: some that were refused passed when a step was known
    lines.push_back(fmt::format("sensor: refused {} packets {}, the last from {}", count,
                                to_string(static_cast<GateCause>(i)),
                                lidar::to_string(figures.gate.last_from[at])));
  }
  if (const long dropped = figures.kernel_drops - last_.kernel_drops; dropped > 0) {
    lines.push_back(
        fmt::format("sensor: the kernel dropped {} packets of others, or that found "
                    "the buffer full; {} turns ended with more to read",
                    dropped, figures.cut_turns - last_.cut_turns));
  }
  if (!lines.empty()) said_ = now;
  last_ = figures;
  return lines;
}

}  // namespace saker::flight
