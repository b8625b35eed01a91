#include "saker/lidar/ouster_stream.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "saker/lidar/imu_packet.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kMostImuSamplesWaiting = 4096;  // 40 s at 100 Hz
constexpr std::size_t kMostImuPacketsWaiting = 16;    // without a packet of the lidar between them
constexpr double kMostClocksApart = 10;               // seconds; one clock drives both in a sensor
constexpr int kApartToBelieve = 3;                    // packets in a row; one may be damaged
constexpr std::size_t kZonePacketBytes = 680;  // zone monitoring; told from others by its size

}  // namespace

OusterStream::OusterStream(const SensorInfo& info, bool keep_ranges, Stamps stamps)
    : info_(info), format_(info), assembler_(info, keep_ranges), clock_(info), stamps_(stamps) {}

void OusterStream::add(std::span<const std::uint8_t> payload) {
  if (payload.size() == format_.packet_bytes()) return add_lidar(payload);
  if (is_imu_packet(payload)) return add_imu(payload);
  if (payload.size() != kZonePacketBytes) assembler_.add(payload);  // counts it
}

void OusterStream::add_lidar(std::span<const std::uint8_t> payload) {
  for (int i = format_.columns_per_packet() - 1; i >= 0; --i) {
    if (!format_.valid(payload, i)) continue;
    last_lidar_ = format_.time(payload, i);
    if (stamps_ == Stamps::go_on) break;
    clock_.hear(format_.frame_id(payload, i), format_.measurement_id(payload, i), last_lidar_);
    break;
  }
  if (!clock_.doubted()) place_imu();
  assembler_.add(payload, clock_.correction());
}

void OusterStream::add_imu(std::span<const std::uint8_t> payload) {
  std::vector<ImuSample> samples = decode_imu(payload, info_);
  if (samples.empty()) {
    ++bad_imu_packets_;
    return;
  }
  imu_packets_.push_back(std::move(samples));
  if (imu_packets_.size() >= kMostImuPacketsWaiting) place_imu();
}

void OusterStream::place_imu() {
  for (std::vector<ImuSample>& samples : imu_packets_) place(std::move(samples));
  imu_packets_.clear();
}

/// Sent before or after the last step: whichever is nearer to the lidar's time.
Time OusterStream::corrected(Time stamp) const {
  const auto at = [stamp](Time correction) { return to_seconds(stamp) + to_seconds(correction); };
  const double now = to_seconds(last_lidar_) + to_seconds(clock_.correction());
  const bool before =
      std::abs(at(clock_.correction_before()) - now) < std::abs(at(clock_.correction()) - now);
  const Time correction = before ? clock_.correction_before() : clock_.correction();
  return static_cast<Time>(static_cast<std::uint64_t>(stamp) +
                           static_cast<std::uint64_t>(correction));
}

void OusterStream::place(std::vector<ImuSample> samples) {
  if (!imu_by_arrival_ && last_lidar_ != 0) {
    const double apart = std::abs(to_seconds(samples.back().stamp) - to_seconds(last_lidar_));
    imu_apart_ = apart > kMostClocksApart ? imu_apart_ + 1 : 0;
    imu_by_arrival_ = imu_apart_ >= kApartToBelieve;
    if (imu_apart_ > 0 && !imu_by_arrival_) {
      late_imu_samples_ += static_cast<int>(samples.size());
      return;
    }
  }
  if (imu_by_arrival_) time_by_arrival(samples);
  for (ImuSample& sample : samples) {
    sample.stamp = corrected(sample.stamp);
    keep(sample);
  }
}

void OusterStream::time_by_arrival(std::vector<ImuSample>& samples) {
  const auto newest = static_cast<std::uint64_t>(samples.back().stamp);
  for (ImuSample& sample : samples) {  // without a sign, as any bytes may come
    const std::uint64_t before = newest - static_cast<std::uint64_t>(sample.stamp);
    sample.stamp = static_cast<Time>(static_cast<std::uint64_t>(last_lidar_) - before);
  }
}

void OusterStream::keep(const ImuSample& sample) {
  const auto newer = [](Time stamp, const ImuSample& s) { return stamp < s.stamp; };
  const auto at = std::upper_bound(imu_.begin(), imu_.end(), sample.stamp, newer);
  const Time before = at == imu_.begin() ? last_imu_given_ : std::prev(at)->stamp;
  if (sample.stamp <= before) {
    ++late_imu_samples_;
    return;
  }
  ++imu_samples_;
  imu_.insert(at, sample);
  if (imu_.size() > kMostImuSamplesWaiting) imu_.pop_front();
}

void OusterStream::finish() {
  place_imu();
  assembler_.finish();
}

std::optional<OusterStream::Item> OusterStream::take() {
  auto assembled = assembler_.take();
  if (!assembled) return std::nullopt;
  Item item;
  item.frame.scan = std::move(assembled->scan);
  item.frame.imu = imu_until(item.frame.scan.stamp);
  item.frame.name = running_name(next_name_++);
  item.assembled = std::move(*assembled);
  return item;
}

std::vector<ImuSample> OusterStream::imu_until(Time stamp) {
  std::vector<ImuSample> samples;
  while (!imu_.empty() && imu_.front().stamp <= stamp) {
    samples.push_back(imu_.front());
    imu_.pop_front();
  }
  if (!samples.empty()) last_imu_given_ = samples.back().stamp;
  return samples;
}

SourceCounters OusterStream::counters() const {
  const AssemblerCounters& from = assembler_.counters();
  SourceCounters counters;
  counters.bad_packets = from.bad_packets + bad_imu_packets_;
  counters.bad_columns = from.bad_columns;
  counters.late_packets = from.late_packets;
  counters.repeated_columns = from.repeated_columns;
  counters.missing_columns = from.missing_columns;
  counters.lost_frames = from.lost_frames;
  counters.clock_steps = clock_.steps();
  counters.imu_samples = imu_samples_;
  counters.late_imu_samples = late_imu_samples_;
  return counters;
}

std::string running_name(int number) {
  char name[16];
  std::snprintf(name, sizeof name, "%06d", number);
  return name;
}

}  // namespace saker::lidar
