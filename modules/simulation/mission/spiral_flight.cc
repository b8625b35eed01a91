#include "saker/simulation/mission/spiral_flight.h"

#include "saker/lidar/imu_packet.h"

namespace saker::simulation {
namespace {

constexpr Time kStart = 1000 * kNanosecondsPerSecond;  ///< of the sensor's clock

MissionConfig unit_config(const SpiralConfig& config) {
  MissionConfig unit;
  unit.capture = config.capture;
  unit.receiver = config.receiver;
  unit.latency_s = 0;
  return unit;
}

}  // namespace

SpiralFlight::SpiralFlight(const SpiralConfig& config, const SpiralSubject& subject,
                           std::uint64_t seed)
    : config_(config),
      site_(build_spiral_world(config, subject, seed)),
      caster_(site_.world),
      start_(kStart),
      unit_(unit_config(config), caster_, site_.world, start_, seed),
      stream_(unit_.info()),
      hits_(unit_.hits()) {
  core::Rng rng = core::Rng(seed).fork(1);
  imu_ = simulate_imu([this](double t) { return site_.path.pose(t); }, config.imu,
                      unit_.info().T_sensor_imu, config.duration_s, start_, rng);
}

int SpiralFlight::expected_scans() const {
  return static_cast<int>(config_.duration_s * unit_.info().frame_rate_hz);
}

SE3 SpiralFlight::T_sim_lidar(Time stamp) const {
  return site_.path.pose(to_seconds(stamp - start_));
}

int SpiralFlight::returns(Time stamp, ObjectId object) const {
  const auto revolution = returns_.find(stamp);
  return revolution == returns_.end() ? 0 : revolution->second[object];
}

std::optional<lidar::Frame> SpiralFlight::next() {
  while (unit_.revolutions() < expected_scans()) {
    if (auto item = stream_.take()) return std::move(item->frame);
    turn();
  }
  stream_.finish();
  if (auto item = stream_.take()) return std::move(item->frame);
  return std::nullopt;
}

/// One packet's columns, after the inertial samples up to then.
void SpiralFlight::turn() {
  const Time end = unit_.block_end();
  for (; imu_sent_ < imu_.size() && imu_[imu_sent_].stamp <= end; ++imu_sent_) {
    stream_.add(lidar::encode_imu(imu_[imu_sent_], unit_.info()));
  }
  const bool revolution = unit_.turn([this](Time at) { return T_sim_lidar(at); }, queue_);
  for (const SensorDatagram& datagram : queue_.take_until(end)) stream_.add(datagram.payload);
  if (!revolution) return;
  std::vector<int>& returns = returns_[unit_.scan_stamp()];
  for (std::size_t i = 0; i < hits_.size(); ++i) returns.push_back(unit_.hits()[i] - hits_[i]);
  hits_ = unit_.hits();
}

}  // namespace saker::simulation
