#include "saker/lidar/osf/osf_recording.h"

#include <algorithm>
#include <cstring>

#include "saker/core/error.h"
#include "saker/lidar/bags/decompress.h"
#include "saker/lidar/metadata.h"
#include "saker/lidar/osf/osf_image.h"
#include "saker/lidar/osf/osf_imu.h"
#include "saker/lidar/ouster_stream.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kCheckBytes = 4;  // behind each block
constexpr std::size_t kLargestBlock = std::size_t{1} << 30;
constexpr std::size_t kLargestMetadata = 16 << 20;
constexpr std::size_t kMostImuWaiting = 16384;  // 40 s at 400 Hz
constexpr std::uint8_t kRangeField = 1, kReflectivityField = 5;

// Fields of the tables, in their order in the vendor's schemas.
enum Header { kMetadataOffset = 2 };
enum Metadata { kEntries = 4 };
enum Entry { kEntryId = 0, kEntryType = 1, kEntryBuffer = 2 };
enum Chunk { kMessages = 0 };
enum Message { kMessageId = 1, kMessageBuffer = 2 };
enum SensorMessage { kLidarSensorId = 0, kScanStreamId = 1, kSensorInfo = 2 };
enum ScanMessage {
  kChannels = 0,
  kFieldTypes = 1,
  kColumnTimes = 2,
  kColumnStatus = 4,
  kFrameId = 5
};

std::string text(const FlatTable& table, std::size_t field) {
  return std::string(text_of(table.bytes(field)));
}

template <class T>
std::vector<T> numbers(const FlatTable& table, std::size_t field) {
  const ByteView bytes = table.bytes(field, sizeof(T));
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

/// Rows as sent, whatever way the image was packed.
template <class T>
std::vector<T> staggered(const OsfImage& image, const SensorInfo& info) {
  const std::size_t columns = image.columns;
  std::vector<T> values(image.rows * columns);
  for (std::size_t row = 0; row < image.rows; ++row) {
    const int shift = image.destaggered ? info.pixel_shift_by_row[row] : 0;
    const auto width = static_cast<int>(columns);
    const auto moved = static_cast<std::size_t>((shift % width + width) % width);
    for (std::size_t column = 0; column < columns; ++column) {
      const std::uint64_t value = image.pixel(row, (column + moved) % columns);
      values[row * columns + column] =
          static_cast<T>(std::min<std::uint64_t>(value, std::numeric_limits<T>::max()));
    }
  }
  return values;
}

/// The channel of that kind; empty where the scan has none.
ByteView channel_of(const FlatTable& scan, std::uint8_t kind) {
  const ByteView types = scan.bytes(kFieldTypes, 2);
  const std::vector<FlatTable> channels = scan.tables(kChannels);
  for (std::size_t i = 0; i < channels.size() && 2 * i + 1 < types.size(); ++i) {
    if (types[2 * i] == kind) return channels[i].bytes(0);
  }
  return {};
}

}  // namespace

OsfRecording::OsfRecording(const std::filesystem::path& file, const RecordingOptions& options)
    : where_(file.string()), file_(file) {
  const auto header = next_block();
  if (!header || header->kind != "OSF$") throw Error(where_ + ": no OSF file");
  first_at_ = at_;
  metadata_at_ = FlatTable::root(header->bytes, false).number<std::uint64_t>(kMetadataOffset, 0);
  find_streams(options);
  at_ = first_at_;
  amiss_.clear();
  assembler_ = std::make_unique<ScanAssembler>(info_, options.keep_ranges);
}

std::optional<OsfRecording::Block> OsfRecording::next_block() {
  std::vector<std::uint8_t> head;
  file_.read(at_, 4, head);
  if (head.empty()) return std::nullopt;
  Cursor cursor(head);
  const std::size_t size = cursor.number<std::uint32_t>();
  Block block;
  file_.read(at_ + 4, std::min(size, kLargestBlock), block.bytes);
  if (!cursor.ok() || block.bytes.size() != size || size < 8) {
    amiss_ = "cut or damaged at byte " + std::to_string(at_);
    at_ = file_.size();
    return std::nullopt;
  }
  block.kind = std::string(text_of(ByteView(block.bytes).subspan(4, 4)));
  at_ += 4 + size + kCheckBytes;
  return block;
}

void OsfRecording::read_metadata_block(const FlatTable& metadata,
                                       std::map<std::uint32_t, Stream>& streams) {
  std::map<std::uint32_t, std::string> sensors;
  const std::vector<FlatTable> entries = metadata.tables(kEntries);
  for (const FlatTable& entry : entries) {
    if (text(entry, kEntryType) != "ouster/v1/os_sensor/LidarSensor") continue;
    const FlatTable sensor = FlatTable::root(entry.bytes(kEntryBuffer), true);
    sensors[entry.number<std::uint32_t>(kEntryId, 0)] = text(sensor, 0);
  }
  for (const FlatTable& entry : entries) {
    if (text(entry, kEntryType) != "ouster/v1/os_sensor/LidarScanStream") continue;
    const FlatTable stream = FlatTable::root(entry.bytes(kEntryBuffer), true);
    const auto sensor = sensors.find(stream.number<std::uint32_t>(0, 0));
    if (sensor == sensors.end()) continue;
    streams[entry.number<std::uint32_t>(kEntryId, 0)] = {
        sensor->first, parse_metadata(sensor->second, where_ + ", metadata in it")};
  }
}

void OsfRecording::read_sensor_message(ByteView message, std::map<std::uint32_t, Stream>& streams) {
  const FlatTable table = FlatTable::root(message, true);
  std::vector<std::uint8_t> json;
  if (!decompress(Compression::kZstd, table.bytes(kSensorInfo), kLargestMetadata, json)) return;
  const auto stream = table.number<std::uint32_t>(kScanStreamId, 0);
  if (streams.contains(stream)) return;
  streams[stream] = {table.number<std::uint32_t>(kLidarSensorId, 0),
                     parse_metadata(std::string(text_of(json)), where_ + ", metadata in it")};
}

/// The metadata stand at the end; newer files have them in their first chunk, too.
void OsfRecording::find_streams(const RecordingOptions& options) {
  std::map<std::uint32_t, Stream> streams;
  const std::optional<Block> first = next_block();
  if (metadata_at_ > first_at_) {
    at_ = metadata_at_;
    if (const auto block = next_block(); block && block->kind == "OSF#") {
      read_metadata_block(FlatTable::root(block->bytes, false), streams);
    }
  }
  at_ = first_at_;  // a file that was not closed does not say where
  while (streams.empty()) {
    const auto block = next_block();
    if (!block) break;
    if (block->kind == "OSF#") {
      read_metadata_block(FlatTable::root(block->bytes, false), streams);
    }
  }
  if (streams.empty() && first && first->kind == "OSF!") {
    const FlatTable chunk = FlatTable::root(first->bytes, false);
    for (const FlatTable& message : chunk.tables(kMessages)) {
      read_sensor_message(message.bytes(kMessageBuffer), streams);
    }
  }
  if (streams.empty()) {
    throw Error(where_ + ": no scans of a sensor with metadata in it" +
                (amiss_.empty() ? "" : " (" + amiss_ + ")"));
  }
  choose(streams, options.sensor);
}

void OsfRecording::choose(const std::map<std::uint32_t, Stream>& streams,
                          const std::string& sensor) {
  std::string serials;
  for (const auto& [id, stream] : streams) {
    serials += (serials.empty() ? "" : ", ") + stream.info.serial_number;
    const bool only = sensor.empty() && streams.size() == 1;
    if (!only && (sensor.empty() || stream.info.serial_number != sensor)) continue;
    stream_ = id;
    info_ = stream.info;
    return;
  }
  throw Error(where_ + ": sensors " + serials +
              (sensor.empty() ? ": choose one with --sensor" : ", expected --sensor " + sensor));
}

std::string OsfRecording::take_scan(const FlatTable& scan) {
  const auto rows = static_cast<std::size_t>(info_.rows);
  const auto columns = static_cast<std::size_t>(info_.columns);
  OsfImage ranges, reflectivity;
  if (!unpack_osf_image(channel_of(scan, kRangeField), rows, columns, ranges)) {
    return "its ranges are not there or damaged";
  }
  std::vector<std::uint8_t> reflected(rows * columns);
  if (unpack_osf_image(channel_of(scan, kReflectivityField), rows, columns, reflectivity)) {
    reflected = staggered<std::uint8_t>(reflectivity, info_);
  }
  std::vector<Time> times;
  for (const std::uint64_t time : numbers<std::uint64_t>(scan, kColumnTimes)) {
    times.push_back(static_cast<Time>(std::min<std::uint64_t>(time, INT64_MAX)));
  }
  std::vector<std::uint8_t> here;
  for (const std::uint32_t status : numbers<std::uint32_t>(scan, kColumnStatus)) {
    here.push_back(static_cast<std::uint8_t>(status & 1));
  }
  if (times.size() != columns || here.size() != columns) {
    return std::to_string(times.size()) + " columns, expected " + std::to_string(columns);
  }
  if (std::find(here.begin(), here.end(), 1) == here.end()) return "no column is valid";
  const std::vector<std::uint32_t> range = staggered<std::uint32_t>(ranges, info_);
  assembler_->add_frame({scan.number<std::int32_t>(kFrameId, 0), range, reflected, times, here});
  return "";
}

void OsfRecording::take_imu(const FlatTable& message) {
  for (const ImuSample& sample : osf_imu_samples(message, info_)) {
    if (sample.stamp <= newest_imu_) {
      ++counters_.late_imu_samples;
      continue;
    }
    newest_imu_ = sample.stamp;
    ++counters_.imu_samples;
    imu_.push_back(sample);
    if (imu_.size() > kMostImuWaiting) imu_.pop_front();
  }
}

std::optional<AssembledScan> OsfRecording::next_scan(std::string& fault) {
  while (true) {
    while (messages_.empty()) {
      chunk_ = next_block();
      if (!chunk_) return std::nullopt;
      if (chunk_->kind != "OSF!") continue;
      for (const FlatTable& m : FlatTable::root(chunk_->bytes, false).tables(kMessages)) {
        if (m.number<std::uint32_t>(kMessageId, 0) == stream_) messages_.push_back(m);
      }
    }
    const FlatTable message = messages_.front();
    messages_.pop_front();
    const FlatTable content = FlatTable::root(message.bytes(kMessageBuffer), true);
    take_imu(content);
    fault = take_scan(content);
    auto scan = assembler_->take();
    if (scan || !fault.empty()) return scan ? std::move(*scan) : AssembledScan{};
  }
}

std::optional<Frame> OsfRecording::next() {
  Frame frame;
  auto scan = next_scan(frame.fault);
  if (!scan) return std::nullopt;
  frame.scan = std::move(scan->scan);
  while (!imu_.empty() && imu_.front().stamp <= frame.scan.stamp) {
    frame.imu.push_back(imu_.front());
    imu_.pop_front();
  }
  given_ = std::move(*scan);
  frame.name = running_name(next_name_++);
  counters_.faulty_scans += !frame.fault.empty();
  return frame;
}

SourceCounters OsfRecording::counters() const {
  SourceCounters counters = counters_;
  counters.bad_columns = assembler_->counters().bad_columns;
  counters.missing_columns = assembler_->counters().missing_columns;
  counters.lost_frames = assembler_->counters().lost_frames;
  counters.ended_early = amiss_;
  return counters;
}

}  // namespace saker::lidar
