#include "tools/saker/faults/packet_faults.h"

#include <algorithm>
#include <cmath>

#include "saker/lidar/imu_packet.h"

namespace saker::tools {
namespace {

constexpr double kTurnPerAcceleration = 0.02;  // rad/s a m/s²: a gyroscope's error beside
                                               // an accelerometer's, as of one cheap unit
constexpr double kNearestDrop_m = 0.4, kFarthestDrop_m = 8;
constexpr double kMillimetres = 1000;

Eigen::Vector3d direction(const Fault& fault) {
  core::Rng rng(fault.seed);
  return Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
}

}  // namespace

PacketFaults::PacketFaults(const FaultSchedule& schedule, const lidar::SensorInfo& sensor)
    : schedule_(schedule), sensor_(sensor), format_(sensor), rng_(7) {}

void PacketFaults::apply(double t_s, std::vector<std::uint8_t>& payload) {
  const Time clock = clock_error(t_s);
  if (lidar::is_imu_packet(payload)) {
    if (!garbled(FaultPlace::imu, t_s, payload)) apply_to_imu(t_s, clock, payload);
  } else {
    if (!garbled(FaultPlace::lidar, t_s, payload)) apply_to_lidar(t_s, clock, payload);
  }
}

/// By which the sensor's clock is ahead of the true time.
Time PacketFaults::clock_error(double t_s) const {
  double error_s = 0;
  for (const Fault& fault : schedule_) {
    if (t_s < fault.at_s) continue;
    const double run_s = std::min(t_s - fault.at_s, fault.lasts_s);
    if (fault.kind == FaultKind::clock_drift) error_s += 1e-6 * fault.strength * run_s;
    if (fault.kind == FaultKind::clock_step && fault.acts(t_s)) error_s += fault.strength;
  }
  return from_seconds(error_s);
}

bool PacketFaults::garbled(FaultPlace place, double t_s, std::vector<std::uint8_t>& payload) {
  const Fault* fault = acting(schedule_, FaultKind::garbage, place, t_s);
  if (fault == nullptr || !rng_.chance(fault->strength)) return false;
  for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(rng_.index(256));
  return true;
}

void PacketFaults::apply_to_imu(double t_s, Time clock, std::vector<std::uint8_t>& payload) {
  const auto at = [&](FaultKind kind) { return acting(schedule_, kind, FaultPlace::none, t_s); };
  const Fault* bias = at(FaultKind::imu_bias);
  const Fault* shaking = at(FaultKind::imu_vibration);
  const Fault* clipped = at(FaultKind::imu_saturation);
  if (clock == 0 && bias == nullptr && shaking == nullptr && clipped == nullptr) return;
  std::vector<lidar::ImuSample> samples = lidar::decode_imu(payload, sensor_);
  if (samples.size() != 1) return;
  lidar::ImuSample& sample = samples.front();
  sample.stamp += clock;
  if (bias != nullptr) {
    sample.acceleration += bias->strength * direction(*bias);
    sample.angular_velocity += kTurnPerAcceleration * bias->strength * direction(*bias);
  }
  if (shaking != nullptr) {
    const double sd = shaking->strength;
    for (int i = 0; i < 3; ++i) {
      sample.acceleration[i] += rng_.normal(0, sd);
      sample.angular_velocity[i] += rng_.normal(0, kTurnPerAcceleration * sd);
    }
  }
  if (clipped != nullptr) {
    const double most = clipped->strength;
    sample.acceleration = sample.acceleration.cwiseMax(-most).cwiseMin(most);
  }
  payload = lidar::encode_imu(sample, sensor_);
}

void PacketFaults::apply_to_lidar(double t_s, Time clock, std::vector<std::uint8_t>& payload) {
  const auto at = [&](FaultKind kind) { return acting(schedule_, kind, FaultPlace::none, t_s); };
  const Fault* dead = at(FaultKind::rows_dead);
  const Fault* covered = at(FaultKind::view_covered);
  const Fault* drops = at(FaultKind::rain);
  const bool spoiled = dead != nullptr || covered != nullptr || drops != nullptr;
  if ((clock == 0 && !spoiled) || payload.size() != format_.packet_bytes()) return;
  std::vector<lidar::Column> columns;
  for (int i = 0; i < format_.columns_per_packet(); ++i) {
    columns.push_back(format_.column(payload, i));
    columns.back().time += clock;
    if (spoiled) spoil(columns.back(), dead, covered, drops);
  }
  payload = format_.encode(columns);
}

void PacketFaults::spoil(lidar::Column& column, const Fault* dead, const Fault* covered,
                         const Fault* drops) {
  if (dead != nullptr) {
    for (std::size_t row = 0; row < column.pixels.size(); ++row) {
      if (core::Rng(dead->seed).fork(row).uniform() < dead->strength) column.pixels[row] = {};
    }
  }
  if (covered != nullptr) {
    const int columns = sensor_.columns;
    const int first = static_cast<int>(covered->seed % static_cast<std::uint64_t>(columns));
    const int since = (column.measurement_id - first + columns) % columns;
    if (since < covered->strength * columns) std::ranges::fill(column.pixels, lidar::Pixel{});
  }
  if (drops == nullptr) return;
  for (lidar::Pixel& pixel : column.pixels) {
    if (!rng_.chance(drops->strength)) continue;
    const auto range_mm =
        static_cast<std::uint32_t>(kMillimetres * rng_.uniform(kNearestDrop_m, kFarthestDrop_m));
    if (pixel.range_mm == 0 || range_mm < pixel.range_mm) pixel = {range_mm, 20, 5, 3};
  }
}

std::vector<std::vector<std::uint8_t>> PacketFaults::company(
    double t_s, const std::vector<std::uint8_t>& payload) {
  const FaultPlace place = lidar::is_imu_packet(payload) ? FaultPlace::imu : FaultPlace::lidar;
  std::vector<std::vector<std::uint8_t>> others;
  if (const Fault* fault = acting(schedule_, FaultKind::forge, place, t_s)) {
    others.push_back(forged(payload, from_seconds(fault->strength)));
  }
  if (const Fault* fault = acting(schedule_, FaultKind::flood, place, t_s)) {
    others.resize(others.size() + static_cast<std::size_t>(fault->strength), payload);
  }
  return others;
}

/// From who knows the sensor, but not its time and frame.
std::vector<std::uint8_t> PacketFaults::forged(const std::vector<std::uint8_t>& payload,
                                               Time ahead) {
  constexpr int kFrames = 65536;
  if (lidar::is_imu_packet(payload)) {
    std::vector<lidar::ImuSample> samples = lidar::decode_imu(payload, sensor_);
    if (samples.size() != 1) return payload;
    samples.front().stamp += ahead;
    samples.front().acceleration.setConstant(rng_.uniform(-20, 20));
    return lidar::encode_imu(samples.front(), sensor_);
  }
  if (payload.size() != format_.packet_bytes()) return payload;
  std::vector<lidar::Column> columns;
  const int frame = rng_.index(kFrames);
  for (int i = 0; i < format_.columns_per_packet(); ++i) {
    columns.push_back(format_.column(payload, i));
    columns.back().time += ahead;
    columns.back().frame_id = frame;
  }
  return format_.encode(columns);
}

}  // namespace saker::tools
