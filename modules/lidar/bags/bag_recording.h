#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/lidar/bags/message_file.h"
#include "saker/lidar/bags/ros_messages.h"
#include "saker/lidar/bags/topic_choice.h"
#include "saker/lidar/clouds/point_layout.h"
#include "saker/lidar/ouster_stream.h"
#include "saker/lidar/recording.h"
#include "saker/lidar/spinning/spinning_capture.h"

namespace saker::lidar {

/// Scans and inertial samples of a ROS bag or an MCAP file.
///
/// Clouds are unorganised scans with ring numbers where the points have them; where the points have
/// times the stamp is the last one's, else the message's. Inertial samples are turned into the
/// clouds' frame by /tf_static, and those in g brought to m/s². Ouster's packets are decoded by the
/// metadata that is in the bag, or given.
class BagRecording : public ScanSource {
 public:
  /// Throws Error when there are no scans, several topics with some and none is chosen, or packets
  /// without metadata.
  BagRecording(const RecordingParts& parts, const RecordingOptions& options);

  [[nodiscard]] std::optional<Frame> next() override;
  [[nodiscard]] SourceCounters counters() const override;
  [[nodiscard]] int expected_scans() const override { return expected_; }
  [[nodiscard]] std::string note() const override;
  [[nodiscard]] std::string sensor_name() const override {
    return spinning_ ? spinning_->model().name : std::string();
  }
  [[nodiscard]] const AssembledScan* assembled() const override {
    return stream_ ? &given_ : nullptr;
  }

 private:
  /// What the first messages tell.
  struct Prelude {
    std::string metadata;
    std::vector<TransformMessage> transforms;
    std::string cloud_frame, imu_frame;
    std::vector<double> accelerations;
  };

  [[nodiscard]] Prelude read_prelude(const RecordingParts& parts) const;
  void hear(const Message& message, const Topic& topic, Prelude& prelude) const;
  void take_mount(const Prelude& prelude);
  void begin_spinning(const RecordingParts& parts, const RecordingOptions& options);
  void take_spinning(const Message& message, const Topic& topic);
  [[nodiscard]] bool is_scan(std::size_t topic) const;
  void take(const Message& message);
  void take_cloud(const Message& message, Encoding encoding);
  void take_imu(const Message& message, Encoding encoding);
  void take_packet(const Message& message, Encoding encoding);
  [[nodiscard]] bool ready() const;
  [[nodiscard]] Frame give();

  std::string where_;
  std::unique_ptr<MessageFile> file_;
  TopicChoice choice_;
  std::optional<OusterStream> stream_;      // of packets
  std::optional<SpinningStream> spinning_;  // of packets of another maker
  std::string sensor_note_;
  std::optional<PointReader> reader_;  // of clouds; made for the first
  Eigen::Matrix3d R_lidar_imu_ = Eigen::Matrix3d::Identity();
  double acceleration_unit_ = 1;  // m/s²
  std::string mount_note_;
  std::deque<Frame> pending_;  // wait for their inertial samples
  std::deque<ImuSample> imu_;  // by time
  Time newest_imu_ = 0;
  std::deque<AssembledScan> assembled_;  // of packets, as many as are pending
  AssembledScan given_;
  bool over_ = false;
  int expected_ = 0;
  int next_name_ = 0;
  SourceCounters counters_;
};

}  // namespace saker::lidar
