#include "saker/lidar/bags/bag_recording.h"

#include <algorithm>
#include <limits>

#include "saker/core/error.h"
#include "saker/core/one_line.h"
#include "saker/lidar/metadata.h"

namespace saker::lidar {
namespace {

constexpr double kStandardGravity = 9.80665;
constexpr long kMostPreludeMessages = 5000;
constexpr std::size_t kMostAccelerations = 500;
constexpr std::size_t kMostPending = 3;         // scans that wait for inertial samples
constexpr std::size_t kMostImuSamples = 16384;  // 40 s at 400 Hz

/// An inertial unit at rest or in gentle motion measures 1 g most of the time.
double unit_of_acceleration(std::vector<double> norms) {
  if (norms.empty()) return 1;
  const auto middle = norms.begin() + static_cast<std::ptrdiff_t>(norms.size() / 2);
  std::nth_element(norms.begin(), middle, norms.end());
  return *middle > 0.5 && *middle < 2 ? kStandardGravity : 1;
}

bool same(const PointLayout& a, const PointLayout& b) {
  return a.step == b.step && a.big_endian == b.big_endian && a.names() == b.names();
}

}  // namespace

BagRecording::BagRecording(const RecordingParts& parts, const RecordingOptions& options)
    : where_(parts.files.front().string()), file_(open_messages(parts)) {
  choice_ = choose_topics(file_->topics(), options.topics, where_);
  const Prelude prelude = read_prelude(parts);
  if (choice_.kind == ScanMessage::kOusterPackets) {
    if (options.metadata.empty() && prelude.metadata.empty()) {
      throw Error(where_ + ": no sensor metadata in it, expected --meta FILE");
    }
    stream_.emplace(options.metadata.empty()
                        ? parse_metadata(prelude.metadata, where_ + ", metadata in it")
                        : read_metadata(options.metadata),
                    options.keep_ranges);
  } else {
    take_mount(prelude);
    if (choice_.kind == ScanMessage::kSpinningPackets) begin_spinning(parts, options);
    expected_ = static_cast<int>(std::min<long>(file_->topics()[choice_.scans.front()].messages,
                                                std::numeric_limits<int>::max()));
  }
}

/// The first packet says of which sensor they are.
void BagRecording::begin_spinning(const RecordingParts& parts, const RecordingOptions& options) {
  const auto file = open_messages(parts);
  std::string unread = "no packet";
  while (const auto message = file->next()) {
    if (!is_scan(message->topic)) continue;
    const Topic& topic = file->topics()[message->topic];
    for (const TimedPacket& packet : read_packets(message->bytes, topic.encoding, topic.type)) {
      if (const auto first = read_spinning_packet(packet.bytes)) {
        spinning_.emplace(
            calibrated_model(first->kind, options.metadata, parts.files.front(), sensor_note_));
        return;
      }
      if (const std::string is = unread_spinning_packet(packet.bytes); !is.empty()) unread = is;
    }
  }
  throw Error(where_ + ": " + choice_.name + ": no packets that are read, found " + unread);
}

BagRecording::Prelude BagRecording::read_prelude(const RecordingParts& parts) const {
  Prelude prelude;
  const auto file = open_messages(parts);
  const bool packets = choice_.kind == ScanMessage::kOusterPackets;
  for (long i = 0; i < kMostPreludeMessages || (packets && prelude.metadata.empty()); ++i) {
    const auto message = file->next();
    if (!message) break;
    hear(*message, file->topics()[message->topic], prelude);
    if (packets && !prelude.metadata.empty()) break;
  }
  return prelude;
}

void BagRecording::hear(const Message& message, const Topic& topic, Prelude& prelude) const {
  if (is_static_transform(topic)) {
    for (auto& t : read_transforms(message.bytes, topic.encoding)) {
      prelude.transforms.push_back(std::move(t));
    }
  } else if (is_metadata(topic) && prelude.metadata.empty()) {
    const auto text = read_string(message.bytes, topic.encoding);
    if (text && text->find("beam_altitude_angles") != std::string::npos) prelude.metadata = *text;
  } else if (is_scan(message.topic) && prelude.cloud_frame.empty()) {
    prelude.cloud_frame = MessageReader(message.bytes, topic.encoding).header().frame;
  } else if (static_cast<int>(message.topic) == choice_.imu &&
             prelude.accelerations.size() < kMostAccelerations) {
    const auto imu = read_imu(message.bytes, topic.encoding);
    if (!imu) return;
    prelude.imu_frame = imu->header.frame;
    prelude.accelerations.push_back(imu->acceleration.norm());
  }
}

void BagRecording::take_mount(const Prelude& prelude) {
  if (choice_.imu < 0) return;
  acceleration_unit_ = unit_of_acceleration(prelude.accelerations);
  if (prelude.imu_frame == prelude.cloud_frame) return;
  const auto T = find_transform(prelude.transforms, prelude.cloud_frame, prelude.imu_frame);
  if (T) {
    R_lidar_imu_ = T->linear();
  } else {
    mount_note_ = one_line("no way from " + prelude.cloud_frame + " to " + prelude.imu_frame +
                           " in /tf_static: the inertial unit's axes count as the lidar's");
  }
}

bool BagRecording::is_scan(std::size_t topic) const {
  return std::find(choice_.scans.begin(), choice_.scans.end(), topic) != choice_.scans.end();
}

std::optional<Frame> BagRecording::next() {
  while (!over_ && !ready()) {
    const auto message = file_->next();
    if (message) {
      take(*message);
    } else {
      over_ = true;
      if (stream_) stream_->finish();
      if (spinning_) spinning_->finish();
    }
    while (spinning_) {
      auto frame = spinning_->take();
      if (!frame) break;
      pending_.push_back(std::move(*frame));
    }
    while (stream_) {
      auto item = stream_->take();
      if (!item) break;
      pending_.push_back(std::move(item->frame));
      assembled_.push_back(std::move(item->assembled));
    }
  }
  if (pending_.empty()) return std::nullopt;
  return give();
}

bool BagRecording::ready() const {
  if (pending_.empty()) return false;
  if (stream_ || choice_.imu < 0) return true;
  return newest_imu_ >= pending_.front().scan.stamp || pending_.size() > kMostPending;
}

Frame BagRecording::give() {
  Frame frame = std::move(pending_.front());
  pending_.pop_front();
  if (stream_) {
    given_ = std::move(assembled_.front());
    assembled_.pop_front();
    return frame;
  }
  while (!imu_.empty() && imu_.front().stamp <= frame.scan.stamp) {
    frame.imu.push_back(imu_.front());
    imu_.pop_front();
  }
  return frame;
}

void BagRecording::take(const Message& message) {
  const Encoding encoding = file_->topics()[message.topic].encoding;
  if (static_cast<int>(message.topic) == choice_.imu) return take_imu(message, encoding);
  if (!is_scan(message.topic)) return;
  if (stream_) return take_packet(message, encoding);
  if (spinning_) return take_spinning(message, file_->topics()[message.topic]);
  take_cloud(message, encoding);
}

void BagRecording::take_cloud(const Message& message, Encoding encoding) {
  Frame frame;
  frame.name = running_name(next_name_++);
  frame.scan.stamp = message.received;
  const auto cloud = choice_.kind == ScanMessage::kLivox
                         ? read_livox(message.bytes, encoding)
                         : read_point_cloud2(message.bytes, encoding);
  if (!cloud) {
    frame.fault = "the message is cut or damaged";
  } else {
    frame.scan.stamp = cloud->header.stamp;
    try {
      if (!reader_ || !same(reader_->layout(), cloud->layout)) {
        reader_.emplace(cloud->layout, choice_.name);
      }
      frame.fault = reader_->read(cloud->data, cloud->rows, cloud->columns, cloud->row_step,
                                  cloud->header.stamp, frame.scan);
    } catch (const Error& error) {
      frame.fault = error.what();
    }
  }
  if (!frame.fault.empty()) {
    ++counters_.faulty_scans;
    const Time stamp = frame.scan.stamp;
    frame.scan = {};
    frame.scan.stamp = stamp;
  }
  pending_.push_back(std::move(frame));
}

void BagRecording::take_imu(const Message& message, Encoding encoding) {
  const auto imu = read_imu(message.bytes, encoding);
  if (!imu) {
    ++counters_.bad_packets;
    return;
  }
  ImuSample sample;
  sample.stamp = imu->header.stamp;
  sample.acceleration = R_lidar_imu_ * imu->acceleration * acceleration_unit_;
  sample.angular_velocity = R_lidar_imu_ * imu->angular_velocity;
  if (!sample.acceleration.allFinite() || !sample.angular_velocity.allFinite()) {
    ++counters_.bad_packets;
    return;
  }
  if (sample.stamp <= newest_imu_) {
    ++counters_.late_imu_samples;
    return;
  }
  newest_imu_ = sample.stamp;
  ++counters_.imu_samples;
  imu_.push_back(sample);
  if (imu_.size() > kMostImuSamples) imu_.pop_front();
}

void BagRecording::take_packet(const Message& message, Encoding encoding) {
  const auto packet = read_packet(message.bytes, encoding);
  if (!packet) {
    ++counters_.bad_packets;
    return;
  }
  // Older drivers send a byte more than the packet has.
  const bool longer = packet->size() == stream_->packet_bytes() + 1;
  stream_->add(longer ? packet->first(packet->size() - 1) : *packet);
}

void BagRecording::take_spinning(const Message& message, const Topic& topic) {
  const auto packets = read_packets(message.bytes, topic.encoding, topic.type);
  if (packets.empty()) ++counters_.bad_packets;
  for (const TimedPacket& packet : packets) spinning_->add(packet.bytes, packet.received);
}

SourceCounters BagRecording::counters() const {
  SourceCounters counters = stream_ ? stream_->counters() : counters_;
  if (stream_) counters.bad_packets += counters_.bad_packets;
  if (spinning_) {
    const SourceCounters from = spinning_->counters();
    counters.bad_packets += from.bad_packets;
    counters.missing_columns += from.missing_columns;
    counters.clock_steps += from.clock_steps;
  }
  counters.ended_early = one_line(file_->amiss());
  return counters;
}

std::string BagRecording::note() const {
  std::string text = "scans of " + choice_.name;
  if (!sensor_note_.empty()) text += " (" + sensor_note_ + ")";
  if (stream_) return text;
  text += choice_.imu >= 0 ? ", inertial samples of " + choice_.imu_name
                           : ", no inertial samples in it";
  if (acceleration_unit_ != 1) text += " (in g)";
  return mount_note_.empty() ? text : text + "; " + mount_note_;
}

}  // namespace saker::lidar
