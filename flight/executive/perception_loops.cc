#include "flight/bus/messages.h"
#include "flight/bus/scan_messages.h"
#include "flight/executive/executive.h"
#include "saker/lidar/imu_packet.h"

/// The loops from packets to the map.
namespace saker::flight {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kMostRows = 400000;  // eleven hours of scans
constexpr int kCyclesPerMap = 4;           // `_OBJECTS` at 0.5 Hz
// Of each network a turn: a hundred times what is heard in flight, so that a flooded channel, which
// holds 256, delays the others by some hundredths of a second.
constexpr int kMostMessages = 128;

}  // namespace

LoopStatus Executive::io() {
  const long handled = bus_.handle(milliseconds(0), kMostMessages);
  const auto now = std::chrono::steady_clock::now();
  if (now - announced_ > Presence::kPeriod) {
    presence_.announce();
    announced_ = now;
  }
  io_cut_turns_ += handled >= kMostMessages;
  return {NAN, io_cut_turns_};
}

LoopStatus Executive::sensor() {
  sensor_line_.turn([this](SensorLine::Packet packet) { take_packet(std::move(packet)); });
  return {NAN, board_.packets.dropped() + board_.imu.dropped()};
}

void Executive::take_packet(SensorLine::Packet packet) {
  for (const lidar::ImuSample& sample : lidar::decode_imu(packet.payload, sensor_)) {
    board_.clock.hear(sample.stamp, packet.arrival);
    board_.imu.push(sample);
  }
  board_.packets.push(std::move(packet.payload));
}

LoopStatus Executive::ingest() {
  for (const auto& packet : board_.packets.take_all()) ingestion_.add(packet);
  auto frame = ingestion_.take_newest();
  board_.newest_scan = ingestion_.newest_stamp();
  if (frame) {
    take_scan(timings_.ingestion.time("odometry",
                                      [&] { return ingestion_.register_scan(std::move(*frame)); }));
  }
  return {age_ms(board_.newest_scan), board_.packets.dropped() + ingestion_.dropped_scans()};
}

void Executive::take_scan(autonomy::IngestedScan scan) {
  const autonomy::RegisteredScan& registered = scan.registered;
  const bool ok = odometry::registered(scan.status);
  if (scan.status == odometry::OdometryStatus::refused) return;
  if (rows_.size() < kMostRows) rows_.push_back({registered.stamp, registered.T_odom_lidar});
  const PoseFix fix{registered.stamp, registered.T_odom_lidar, scan.covariance, ok};
  board_.motions.push(fix);
  if (!ok) return;
  board_.newest_registered = registered.stamp;
  board_.pose_fixes.push(fix);
  for (const scan_t& chunk : to_lcm(registered, ++scan_sequence_)) bus_.publish(chunk);
  board_.scan.put(std::move(scan));
}

LoopStatus Executive::segment() {
  const auto scan = board_.scan.take();
  if (scan == nullptr) return {age_ms(board_.newest_registered), 0};
  auto labels = timings_.ordinary.time("segmentation", [&] {
    return std::make_shared<const lidar::Labels>(segmentation_.segment(*scan->scan));
  });
  const autonomy::RegisteredScan& registered = scan->registered;
  board_.labelled.push({registered.stamp, registered.T_odom_lidar, registered.points,
                        std::move(labels), registered.reflectivity});
  return {age_ms(registered.stamp), 0};
}

LoopStatus Executive::map() {
  for (const PoseFix& step : board_.motions.take_all()) {
    motion_log_.add(step.stamp, step.T_odom_lidar, step.covariance);
  }
  std::vector<detection::LabelledScan> labelled = board_.labelled.take_all();
  const auto old = board_.map.latest();
  if (labelled.empty()) return {age_ms(old ? old->stamp : 0), board_.labelled.dropped()};
  for (detection::LabelledScan& scan : labelled) window_.add(std::move(scan));
  const std::vector<detection::LabelledScan> window = window_.scans();
  auto map = timings_.ordinary.time(
      "mapping", [&] { return mapping_.cycle(window, motion_log_.take(window.back().stamp)); });
  bus_.publish(to_lcm(map->detections));
  if (exchange_ != nullptr) exchange_->add(mapping_.slam().history());
  if (++map_cycles_ % kCyclesPerMap == 0) publish_map(*map);
  board_.map_news.put({map->stamp, map->T_world_odom, map->classified_share});
  board_.map.put(std::move(map));
  return {age_ms(window.back().stamp), board_.labelled.dropped()};
}

LoopStatus Executive::exchange() {
  exchange_->step();
  return {NAN, exchange_->dropped()};
}

void Executive::publish_map(const autonomy::MapSnapshot& map) {
  bus_.publish(map_sender_.next(map.map, map.stamp));
}

}  // namespace saker::flight
