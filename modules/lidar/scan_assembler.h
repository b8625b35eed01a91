#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "saker/lidar/packet.h"
#include "saker/lidar/ray_table.h"
#include "saker/lidar/scan.h"

namespace saker::lidar {

/// One revolution as it arrived, complete or not.
struct AssembledScan {
  Scan scan;  ///< organised, destaggered, sensor frame
  int frame_id = 0;
  Time first_column = 0;  ///< time of the first and of the last column that came
  Time last_column = 0;
  int valid_columns = 0;
  int returns = 0;                       ///< points that are not NaN
  std::vector<std::uint32_t> ranges_mm;  ///< row-major, staggered as sent; only when asked for
};

struct AssemblerCounters {
  int bad_packets = 0;       ///< of another size
  int bad_columns = 0;       ///< outside the frame, or hours away from their neighbours
  int late_packets = 0;      ///< of a frame that had ended: dropped
  int repeated_columns = 0;  ///< there already: dropped
  int missing_columns = 0;   ///< of the window, in frames that are neither the first nor the last
  int lost_frames = 0;       ///< of which nothing came
};

/// Packets in, scans out: places columns by their number in whatever order they come.
///
/// A frame ends when its window is full or a column of another frame comes. Frame numbers wrap at
/// 65536; one that is a little behind is late, one far away is a sensor that restarted. Cost: 0.4
/// ms for 64×1024.
class ScanAssembler {
 public:
  explicit ScanAssembler(const SensorInfo& info, bool keep_ranges = false);

  /// A UDP payload; any bytes are allowed. What it completes can be taken afterwards.
  /// \param correction  ns, added to the stamps of its columns
  void add(std::span<const std::uint8_t> packet, Time correction = 0);

  /// A whole frame that was put together before: pixels row by row, as sent (staggered).
  struct WholeFrame {
    int frame_id = 0;
    std::span<const std::uint32_t> ranges_mm;
    std::span<const std::uint8_t> reflectivity;
    std::span<const Time> column_time;
    std::span<const std::uint8_t> column_here;  ///< not 0: the column came
  };
  void add_frame(const WholeFrame& frame);

  /// The recording is over: ends the frame under way.
  void finish();

  /// The oldest complete scan.
  [[nodiscard]] std::optional<AssembledScan> take();

  [[nodiscard]] std::size_t packet_bytes() const { return format_.packet_bytes(); }
  [[nodiscard]] const AssemblerCounters& counters() const { return counters_; }

 private:
  enum class Verdict { kBelongs, kLate, kNew };

  void add_column(std::span<const std::uint8_t> packet, int i, Time correction, bool& late);
  [[nodiscard]] Verdict judge(int frame_id) const;
  void begin(int frame_id);
  void end();
  void count_missing();
  [[nodiscard]] bool near_in_time(Time time) const;
  [[nodiscard]] AssembledScan build();
  void place_row(int row, AssembledScan& out) const;
  void place_times(AssembledScan& out);

  SensorInfo info_;
  PacketFormat format_;
  RayTable rays_;
  bool keep_ranges_;
  AssemblerCounters counters_;

  // The frame under way; pixels by column, so that a packet writes neighbouring bytes.
  bool open_ = false;
  bool any_ = false;          // a frame has begun before
  bool after_first_ = false;  // the frame under way is not the first one
  int frame_id_ = 0;
  int valid_columns_ = 0;
  Time reference_time_ = 0;  // of the frame's first column
  std::vector<std::uint32_t> ranges_mm_;
  std::vector<std::uint8_t> reflectivity_;
  std::vector<Time> column_time_;
  std::vector<std::uint8_t> column_here_;
  std::vector<std::int32_t> column_offset_ns_;  // filled when the frame ends

  std::deque<AssembledScan> done_;  // what one packet can complete: never more than its columns
};

}  // namespace saker::lidar
