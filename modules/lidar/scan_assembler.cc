#include "saker/lidar/scan_assembler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saker/lidar/frame_number.h"

namespace saker::lidar {
namespace {

constexpr int kMostFramesLate = 16;        // 1.6 s at 10 Hz; anything further back is a restart
constexpr double kMostFramePeriods = 2.0;  // columns of a frame lie at most this far apart
constexpr std::size_t kMostScansWaiting = 256;

constexpr float kMetresPerMillimetre = 1e-3F;
constexpr float kReflectivityScale = 1.0F / 255;

/// Differences of times that came off a wire must not overflow.
double seconds_between(Time a, Time b) {
  return (static_cast<double>(b) - static_cast<double>(a)) * 1e-9;
}

}  // namespace

ScanAssembler::ScanAssembler(const SensorInfo& info, bool keep_ranges)
    : info_(info), format_(info), rays_(info), keep_ranges_(keep_ranges) {
  const std::size_t columns = static_cast<std::size_t>(info.columns);
  ranges_mm_.resize(columns * info.rows);
  reflectivity_.resize(columns * info.rows);
  column_time_.resize(columns);
  column_here_.resize(columns);
  column_offset_ns_.resize(columns);
}

void ScanAssembler::add(std::span<const std::uint8_t> packet, Time correction) {
  if (packet.size() != format_.packet_bytes()) {
    ++counters_.bad_packets;
    return;
  }
  bool late = false;
  for (int i = 0; i < format_.columns_per_packet(); ++i) {
    if (format_.valid(packet, i)) add_column(packet, i, correction, late);
  }
  counters_.late_packets += late;
}

void ScanAssembler::add_column(std::span<const std::uint8_t> packet, int i, Time correction,
                               bool& late) {
  const int column = format_.measurement_id(packet, i);
  const Time sent = format_.time(packet, i);
  const Time time =
      static_cast<Time>(static_cast<std::uint64_t>(sent) +
                        static_cast<std::uint64_t>(correction));  // any bytes may come
  if (column >= info_.columns || time < 0) {
    ++counters_.bad_columns;
    return;
  }
  const int frame_id = format_.frame_id(packet, i);
  switch (judge(frame_id)) {
    case Verdict::kLate:
      late = true;
      return;
    case Verdict::kNew:
      end();
      begin(frame_id);
      reference_time_ = time;
      break;
    case Verdict::kBelongs:
      break;
  }
  if (!near_in_time(time)) {
    ++counters_.bad_columns;
    return;
  }
  if (column_here_[column]) {
    ++counters_.repeated_columns;
    return;
  }
  column_here_[column] = 1;
  column_time_[column] = time;
  ++valid_columns_;
  const std::size_t at = static_cast<std::size_t>(column) * info_.rows;
  format_.read_column(packet, i, &ranges_mm_[at], &reflectivity_[at], 1);
  if (valid_columns_ == info_.column_window.size(info_.columns)) end();
}

void ScanAssembler::add_frame(const WholeFrame& frame) {
  const std::size_t columns = column_here_.size(), pixels = ranges_mm_.size();
  if (frame.ranges_mm.size() != pixels || frame.reflectivity.size() != pixels ||
      frame.column_time.size() != columns || frame.column_here.size() != columns) {
    ++counters_.bad_packets;
    return;
  }
  end();
  begin(frame.frame_id);
  for (std::size_t column = 0; column < columns; ++column) {
    const Time time = frame.column_time[column];
    if (frame.column_here[column] == 0 || time < 0) continue;
    if (valid_columns_ == 0) reference_time_ = time;
    if (!near_in_time(time)) {
      ++counters_.bad_columns;
      continue;
    }
    column_here_[column] = 1;
    column_time_[column] = time;
    ++valid_columns_;
    for (int row = 0; row < info_.rows; ++row) {
      const std::size_t to = column * info_.rows + row, from = row * columns + column;
      ranges_mm_[to] = frame.ranges_mm[from];
      reflectivity_[to] = frame.reflectivity[from];
    }
  }
  end();
}

ScanAssembler::Verdict ScanAssembler::judge(int frame_id) const {
  if (!any_) return Verdict::kNew;
  const int ahead = frames_between(frame_id_, frame_id);
  if (ahead == 0) return open_ ? Verdict::kBelongs : Verdict::kLate;
  return ahead < 0 && ahead >= -kMostFramesLate ? Verdict::kLate : Verdict::kNew;
}

void ScanAssembler::begin(int frame_id) {
  if (any_) {
    const int skipped = frames_between(frame_id_, frame_id) - 1;
    if (skipped > 0 && skipped < kMostFramesLost) counters_.lost_frames += skipped;
  }
  after_first_ = any_;
  any_ = true;
  open_ = true;
  frame_id_ = frame_id;
  valid_columns_ = 0;
  std::fill(column_here_.begin(), column_here_.end(), std::uint8_t{0});
}

bool ScanAssembler::near_in_time(Time time) const {
  return std::abs(seconds_between(reference_time_, time)) * info_.frame_rate_hz <=
         kMostFramePeriods;
}

void ScanAssembler::end() {
  if (!open_) return;
  open_ = false;
  if (after_first_) count_missing();
  if (done_.size() >= kMostScansWaiting) done_.pop_front();
  done_.push_back(build());
}

void ScanAssembler::finish() {
  after_first_ = false;  // the last frame may be cut off: nothing is missing from it
  end();
}

void ScanAssembler::count_missing() {
  for (int column = 0; column < info_.columns; ++column) {
    if (info_.column_window.contains(column) && !column_here_[column]) ++counters_.missing_columns;
  }
}

std::optional<AssembledScan> ScanAssembler::take() {
  if (done_.empty()) return std::nullopt;
  AssembledScan scan = std::move(done_.front());
  done_.pop_front();
  return scan;
}

AssembledScan ScanAssembler::build() {
  AssembledScan out;
  out.frame_id = frame_id_;
  out.valid_columns = valid_columns_;
  out.scan.rows = info_.rows;
  out.scan.columns = info_.columns;
  const std::size_t pixels = ranges_mm_.size();
  out.scan.points.assign(pixels, Eigen::Vector3f::Constant(NAN));
  out.scan.reflectivity.assign(pixels, 0);
  out.scan.offset_ns.assign(pixels, 0);
  if (keep_ranges_) out.ranges_mm.assign(pixels, 0);
  place_times(out);
  for (int row = 0; row < info_.rows; ++row) place_row(row, out);
  return out;
}

void ScanAssembler::place_times(AssembledScan& out) {
  out.first_column = std::numeric_limits<Time>::max();
  int last = 0;
  for (int column = 0; column < info_.columns; ++column) {
    if (!column_here_[column]) continue;
    out.first_column = std::min(out.first_column, column_time_[column]);
    if (column_time_[column] < out.last_column) continue;
    out.last_column = column_time_[column];
    last = column;
  }
  out.scan.stamp = out.last_column;

  const Time period = from_seconds(info_.column_period_s());
  for (int column = 0; column < info_.columns; ++column) {
    const Time offset = column_here_[column] ? column_time_[column] - out.last_column
                                             : std::min<Time>(0, (column - last) * period);
    column_offset_ns_[column] = static_cast<std::int32_t>(offset);
  }
}

void ScanAssembler::place_row(int row, AssembledScan& out) const {
  const int columns = info_.columns;
  const std::size_t start = static_cast<std::size_t>(row) * columns;
  int to = (info_.pixel_shift_by_row[row] % columns + columns) % columns;
  std::rotate_copy(column_offset_ns_.begin(), column_offset_ns_.end() - to, column_offset_ns_.end(),
                   out.scan.offset_ns.begin() + start);
  for (int column = 0; column < columns; ++column) {
    const std::size_t from = static_cast<std::size_t>(column) * info_.rows + row;
    const std::size_t at = start + to;
    to = to + 1 == columns ? 0 : to + 1;
    if (!column_here_[column]) continue;
    const std::uint32_t range_mm = ranges_mm_[from];
    if (keep_ranges_) out.ranges_mm[start + column] = range_mm;
    if (range_mm == 0) continue;
    const RayTable::Ray& ray = rays_.ray(row, column);
    const float range = static_cast<float>(range_mm) * kMetresPerMillimetre;
    out.scan.points[at] = ray.direction * range + ray.origin;
    out.scan.reflectivity[at] = static_cast<float>(reflectivity_[from]) * kReflectivityScale;
    ++out.returns;
  }
}

}  // namespace saker::lidar
