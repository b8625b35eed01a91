#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "saker/lidar/capture_reader.h"
#include "saker/lidar/spinning/spinning_stream.h"

/// Captures of Velodyne's and Hesai's sensors.
namespace saker::lidar {

/// What the first datagrams of a capture (20,000 at most) are, of these makers.
struct SpinningSenders {
  /// Address and destination port, "192.168.1.201:2368".
  struct Sender {
    std::string name;
    SpinningKind kind = SpinningKind::kVlp16;
    int packets = 0;
  };
  std::vector<Sender> senders;
  std::string unread;  ///< what a packet that is not read would be of; or empty
  int datagrams = 0;
  int packets = 0;
};
[[nodiscard]] SpinningSenders find_spinning_senders(const std::filesystem::path& capture);

/// The model with its calibration: the file that is given, or the one beside the recording. Throws
/// Error when the sensor cannot do without and there is none. \param note  what a user has to know
[[nodiscard]] SpinningModel calibrated_model(SpinningKind kind, const std::filesystem::path& given,
                                             const std::filesystem::path& recording,
                                             std::string& note);

/// One spinning sensor of a capture, scan by scan; other traffic is left alone.
class SpinningCapture : public ScanSource {
 public:
  /// Throws Error when several sensors are in it and `options.sensor` (an address, with or without
  /// the port) names none, and when there is no calibration where one is needed
  /// (`options.metadata`, or beside the capture).
  /// \param files  that follow one another
  SpinningCapture(const std::vector<std::filesystem::path>& files, const SpinningSenders& found,
                  const RecordingOptions& options);

  [[nodiscard]] std::optional<Frame> next() override;
  [[nodiscard]] SourceCounters counters() const override;
  [[nodiscard]] std::string sensor_name() const override { return stream_.model().name; }
  [[nodiscard]] std::string note() const override { return note_; }

 private:
  CaptureReader reader_;
  std::string note_;
  std::string only_;  // name of the sender
  SpinningStream stream_;
  bool over_ = false;
  int other_sensors_ = 0;
};

}  // namespace saker::lidar
