#include "saker/lidar/ouster_sensor.h"

#include <poll.h>

#include <array>

namespace saker::lidar {
namespace {

constexpr int kMostPacketsAtOnce = 64;  // so that one port never starves the other

}  // namespace

OusterSensor::OusterSensor(const SensorInfo& info, const OusterSensorOptions& options)
    : stream_(info),
      lidar_(options.lidar_port),
      imu_(options.imu_port),
      silence_(options.silence) {}

std::optional<Frame> OusterSensor::next() {
  while (true) {
    if (auto item = stream_.take()) return std::move(item->frame);
    if (!poll(silence_)) return std::nullopt;
  }
}

bool OusterSensor::poll(std::chrono::milliseconds timeout) {
  std::array<pollfd, 2> ready = {pollfd{imu_.descriptor(), POLLIN, 0},
                                 pollfd{lidar_.descriptor(), POLLIN, 0}};
  if (::poll(ready.data(), ready.size(), static_cast<int>(timeout.count())) <= 0) return false;
  drain(imu_);  // first: a frame wants the samples before it
  drain(lidar_);
  return true;
}

void OusterSensor::drain(UdpReceiver& receiver) {
  for (int packets = 0; packets < kMostPacketsAtOnce; ++packets) {
    const auto packet = receiver.receive(std::chrono::milliseconds(0));
    if (packet.empty()) return;
    stream_.add(packet);
  }
}

}  // namespace saker::lidar
