#include "saker/simulation/sensor/lidar_unit.h"

#include <algorithm>

#include "saker/simulation/mission/capture_files.h"
#include "saker/simulation/mission/truth.h"

namespace saker::simulation {
namespace {

constexpr int kMostOvertaking = 5;  ///< packets that may overtake a late one

}  // namespace

void DatagramQueue::add(SensorDatagram datagram) {
  const auto at = std::upper_bound(
      queue_.begin(), queue_.end(), datagram.received,
      [](Time received, const SensorDatagram& other) { return received < other.received; });
  queue_.insert(at, std::move(datagram));
  if (queue_.size() <= kMost) return;
  queue_.pop_front();
  ++dropped_;
}

std::vector<SensorDatagram> DatagramQueue::take_until(Time now) {
  std::vector<SensorDatagram> taken;
  while (!queue_.empty() && queue_.front().received <= now) {
    taken.push_back(std::move(queue_.front()));
    queue_.pop_front();
  }
  return taken;
}

LidarUnit::LidarUnit(const MissionConfig& config, const RayCaster& caster, const World& world,
                     Time start, std::uint64_t seed)
    : config_(config.capture),
      info_(sensor_info(config.capture)),
      format_(info_),
      latency_(from_seconds(config.latency_s)),
      world_(&world),
      scanner_(caster, world, ouster_beams(info_), config.receiver, seed),
      network_(core::Rng(seed).fork(30)),
      start_(start),
      rng_(scanner_.rng_of(0)),
      scan_(scanner_.empty_scan()),
      hits_(world.objects.size() + 1, 0) {}

Time LidarUnit::column_time(int column) const {
  const Time revolution = from_seconds(frame_ / info_.frame_rate_hz);
  return start_ + revolution + from_seconds(column * info_.column_period_s());
}

Time LidarUnit::block_end() const {
  return column_time((block_ + 1) * Scanner::kColumnsAtOnce - 1);
}

int LidarUnit::last_sent_column() const {
  const lidar::ColumnWindow& window = info_.column_window;
  return window.first <= window.last ? window.last : info_.columns - 1;
}

bool LidarUnit::turn(const PoseAt& pose_at, DatagramQueue& out) {
  const int first = block_ * Scanner::kColumnsAtOnce;
  scanner_.cast_block(
      first, [&](int column) { return pose_at(column_time(column)); }, rng_, scan_);
  send(first, out);
  ++block_;
  if (block_ * Scanner::kColumnsAtOnce < info_.columns) return false;
  scan_stamp_ = column_time(last_sent_column());
  count_hits(*world_, scan_, hits_);
  block_ = 0;
  ++frame_;
  rng_ = scanner_.rng_of(static_cast<std::uint64_t>(frame_));
  scan_ = scanner_.empty_scan();
  return true;
}

void LidarUnit::send(int first_column, DatagramQueue& out) {
  const Time revolution = column_time(0);
  std::vector<lidar::Column> columns;
  for (int i = 0; i < info_.columns_per_packet; ++i)
    columns.push_back(column_of(scan_, info_, format_, frame_ + 1, first_column + i, revolution));
  const bool any = std::any_of(columns.begin(), columns.end(),
                               [](const lidar::Column& column) { return column.valid; });
  if (!any || network_.chance(config_.lost_share)) return;
  SensorDatagram datagram{columns.back().time + latency_, info_.lidar_port,
                          format_.encode(columns)};
  if (network_.chance(config_.late_share)) {
    const double packets = 1.5 + network_.index(kMostOvertaking);
    datagram.received += from_seconds(packets * info_.columns_per_packet * info_.column_period_s());
  }
  if (network_.chance(config_.repeated_share)) out.add(datagram);
  out.add(std::move(datagram));
}

}  // namespace saker::simulation
