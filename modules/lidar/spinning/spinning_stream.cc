#include "saker/lidar/spinning/spinning_stream.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "saker/lidar/bytes.h"
#include "saker/lidar/ouster_stream.h"

namespace saker::lidar {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kHalfTurn = 180;
constexpr Time kLongestScan = 3 * kNanosecondsPerSecond / 2;  // the slowest rotor takes 0.2 s
constexpr std::size_t kMostPoints = 1U << 21;
constexpr double kMostMissing = 1;  // s; longer is a pause of the recording
// The two ranges at which an HDL-64E is calibrated, and the larger one of both.
constexpr double kNearX = 2.4, kNearY = 1.93, kFar = 25.04;

double between(double at, double near, double of_near, double of_far) {
  return of_near + (of_far - of_near) * (at - near) / (kFar - near);
}

}  // namespace

Eigen::Vector3d spinning_point(const SpinningBeam& beam, double azimuth_deg, double range_m) {
  const double azimuth = (azimuth_deg + beam.azimuth_deg) * kDegree;
  const double elevation = beam.elevation_deg * kDegree;
  const double c = std::cos(azimuth), s = std::sin(azimuth);
  const auto ahead = [&](double range) {
    const double flat = range * std::cos(elevation) - beam.up_m * std::sin(elevation);
    return flat * c + beam.aside_m * s;
  };
  const auto right = [&](double range) {
    const double flat = range * std::cos(elevation) - beam.up_m * std::sin(elevation);
    return flat * s - beam.aside_m * c;
  };
  const double range = range_m + beam.distance_m;
  double range_x = range, range_y = range;
  if (beam.two_points) {
    range_x = range_m + between(std::abs(right(range)), kNearX, beam.distance_x_m, beam.distance_m);
    range_y = range_m + between(std::abs(ahead(range)), kNearY, beam.distance_y_m, beam.distance_m);
  }
  return {ahead(range_y), -right(range_x),
          range_y * std::sin(elevation) + beam.up_m * std::cos(elevation)};
}

SpinningStream::SpinningStream(SpinningModel model) : model_(std::move(model)) {}

void SpinningStream::add(ByteView payload, Time received) {
  const auto packet = read_spinning_packet(payload);
  if (!packet || packet->kind != model_.kind) {
    ++counters_.bad_packets;
    return;
  }
  const Time time = clock_.time(packet->clock, packet->clock_period, received);
  count_missing(*packet, time);
  for (const SpinningBlock& block : packet->blocks) {
    const Time block_time = time + static_cast<Time>(std::llround(1000 * block.time_us));
    if (ends_scan(block, block_time)) end_scan();
    if (azimuth_deg_ < 0 || times_.empty()) begun_ = block_time;
    if (azimuth_deg_ >= 0) {
      covered_deg_ += std::abs(std::remainder(block.azimuth_deg - azimuth_deg_, 2 * kHalfTurn));
    }
    azimuth_deg_ = block.azimuth_deg;
    add_block(*packet, block, block_time);
  }
}

/// Packets that did not come, by the sensor's clock.
void SpinningStream::count_missing(const SpinningPacket& packet, Time time) {
  const double apart = to_seconds(time - last_packet_);
  const bool before = last_packet_ != 0;
  last_packet_ = time;
  if (!before || apart <= 0 || apart > kMostMissing) return;
  const std::size_t banks = model_.kind == SpinningKind::kHdl64e ? 2 : 1;
  const auto turns = static_cast<double>(packet.blocks.size() / banks);
  const double packets = apart * 1e6 / (turns * spinning_block_us(model_.kind));
  const int missing = static_cast<int>(std::lround(packets)) - 1;
  if (missing > 0) counters_.missing_columns += missing * static_cast<int>(turns);
}

bool SpinningStream::ends_scan(const SpinningBlock& block, Time time) const {
  if (azimuth_deg_ < 0) return false;
  return std::abs(block.azimuth_deg - azimuth_deg_) > kHalfTurn ||
         std::abs(to_seconds(time - begun_)) > to_seconds(kLongestScan) ||
         scan_.scan.size() > kMostPoints;
}

void SpinningStream::add_block(const SpinningPacket& packet, const SpinningBlock& block,
                               Time time) {
  const std::size_t step = packet.return_bytes;
  const std::size_t returns =
      std::min(block.returns.size() / step, model_.beams.size() - block.first_beam);
  for (std::size_t i = 0; i < returns; ++i) {
    const SpinningBeam& beam = model_.beams[block.first_beam + i];
    const std::uint8_t* at = &block.returns[i * step];
    if (read_little<std::uint16_t>(at) == 0 && !block.others.empty()) at = &block.others[i * step];
    const auto raw = read_little<std::uint16_t>(at);
    if (raw == 0) continue;
    const Eigen::Vector3d point = spinning_point(
        beam, block.azimuth_deg + block.turning_deg_us * beam.firing_us, raw * packet.range_unit_m);
    scan_.scan.points.push_back(point.cast<float>());
    scan_.scan.reflectivity.push_back(static_cast<float>(at[2]) / 255);
    scan_.scan.ring.push_back(beam.ring);
    times_.push_back(time + static_cast<Time>(std::llround(1000 * beam.firing_us)));
  }
}

void SpinningStream::end_scan() {
  Frame frame = std::exchange(scan_, {});
  const std::vector<Time> times = std::exchange(times_, {});
  const bool at_an_end = std::exchange(first_, false);
  const double covered = std::exchange(covered_deg_, 0);
  if (times.empty()) return;
  frame.scan.stamp = *std::max_element(times.begin(), times.end());
  frame.scan.offset_ns.reserve(times.size());
  for (const Time time : times) {
    frame.scan.offset_ns.push_back(static_cast<std::int32_t>(
        std::max<Time>(time - frame.scan.stamp, std::numeric_limits<std::int32_t>::min())));
  }
  if (at_an_end && covered < kHalfTurn) {
    short_ = std::move(frame);
    return;
  }
  frame.name = running_name(next_name_++);
  done_.push_back(std::move(frame));
}

void SpinningStream::finish() {
  first_ = true;  // the last one may be short, too
  std::optional<Frame> before = std::exchange(short_, std::nullopt);
  end_scan();
  if (before && (!short_ || before->scan.size() > short_->scan.size())) short_ = std::move(before);
  if (next_name_ > 0 || !short_) return;
  short_->name = running_name(next_name_++);
  done_.push_back(std::move(*short_));
}

std::optional<Frame> SpinningStream::take() {
  if (done_.empty()) return std::nullopt;
  Frame frame = std::move(done_.front());
  done_.pop_front();
  return frame;
}

SourceCounters SpinningStream::counters() const {
  SourceCounters counters = counters_;
  counters.clock_steps = clock_.steps();
  return counters;
}

}  // namespace saker::lidar
