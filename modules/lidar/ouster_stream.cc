#include "saker/lidar/ouster_stream.h"

#include <algorithm>
#include <cstdio>

#include "saker/lidar/imu_packet.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kMostImuSamplesWaiting = 4096;  // 40 s at 100 Hz

}  // namespace

OusterStream::OusterStream(const SensorInfo& info, bool keep_ranges)
    : info_(info), assembler_(info, keep_ranges) {}

void OusterStream::add(std::span<const std::uint8_t> payload) {
  if (payload.size() == kImuPacketBytes) return add_imu(payload);
  assembler_.add(payload);
}

void OusterStream::add_imu(std::span<const std::uint8_t> payload) {
  const auto sample = decode_imu(payload, info_);
  if (!sample) {
    ++bad_imu_packets_;
    return;
  }
  const auto newer = [](Time stamp, const ImuSample& s) { return stamp < s.stamp; };
  const auto at = std::upper_bound(imu_.begin(), imu_.end(), sample->stamp, newer);
  const Time before = at == imu_.begin() ? last_imu_given_ : std::prev(at)->stamp;
  if (sample->stamp <= before) {
    ++late_imu_samples_;
    return;
  }
  imu_.insert(at, *sample);
  if (imu_.size() > kMostImuSamplesWaiting) imu_.pop_front();
}

void OusterStream::finish() { assembler_.finish(); }

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
  return counters;
}

std::string running_name(int number) {
  char name[16];
  std::snprintf(name, sizeof name, "%06d", number);
  return name;
}

}  // namespace saker::lidar
