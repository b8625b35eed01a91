#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "saker/core/time.h"
#include "saker/lidar/bags/message_file.h"

/// Messages as ROS 1 and CDR put them into bytes, written apart from the readers.
namespace saker::lidar::testing {

class MessageWriter {
 public:
  explicit MessageWriter(Encoding encoding, bool big_endian = false)
      : cdr_(encoding == Encoding::kCdr), big_endian_(big_endian) {
    if (cdr_) bytes_ = {0, static_cast<std::uint8_t>(big_endian ? 0 : 1), 0, 0};
  }

  template <class T>
  void number(T value) {
    if (cdr_) {
      while ((bytes_.size() - 4) % sizeof(T) != 0) bytes_.push_back(0xEE);  // padding
    }
    std::uint8_t raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_.push_back(raw[big_endian_ ? sizeof(T) - 1 - i : i]);
    }
  }

  void text(const std::string& text) {
    number(static_cast<std::uint32_t>(text.size() + (cdr_ ? 1 : 0)));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    if (cdr_) bytes_.push_back(0);
  }

  void bytes(const std::vector<std::uint8_t>& content) {
    number(static_cast<std::uint32_t>(content.size()));
    bytes_.insert(bytes_.end(), content.begin(), content.end());
  }

  void vector(const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) number(v[i]);
  }

  void header(Time stamp, const std::string& frame) {
    if (!cdr_) number(std::uint32_t{7});
    number(static_cast<std::uint32_t>(stamp / kNanosecondsPerSecond));
    number(static_cast<std::uint32_t>(stamp % kNanosecondsPerSecond));
    text(frame);
  }

  [[nodiscard]] const std::vector<std::uint8_t>& done() const { return bytes_; }

 private:
  bool cdr_;
  bool big_endian_;
  std::vector<std::uint8_t> bytes_;
};

struct MadePoint {
  float x, y, z, intensity;
  std::uint32_t t;  ///< ns from the message's stamp
  std::uint16_t ring;
};

/// x, y, z, (four bytes of padding), intensity, t, ring, (six bytes of padding): 32 bytes a point.
inline std::vector<std::uint8_t> made_cloud(const std::vector<MadePoint>& points, Time stamp,
                                            Encoding encoding) {
  struct Field {
    const char* name;
    std::uint32_t offset;
    std::uint8_t type;
  };
  const Field fields[] = {{"x", 0, 7},          {"y", 4, 7},  {"z", 8, 7},
                          {"intensity", 16, 7}, {"t", 20, 6}, {"ring", 24, 4}};
  constexpr std::uint32_t kStep = 32;
  MessageWriter writer(encoding);
  writer.header(stamp, "lidar");
  writer.number(std::uint32_t{1});
  writer.number(static_cast<std::uint32_t>(points.size()));
  writer.number(std::uint32_t{6});
  for (const Field& field : fields) {
    writer.text(field.name);
    writer.number(field.offset);
    writer.number(field.type);
    writer.number(std::uint32_t{1});
  }
  writer.number(std::uint8_t{0});
  writer.number(kStep);
  writer.number(static_cast<std::uint32_t>(kStep * points.size()));
  std::vector<std::uint8_t> data(kStep * points.size(), 0xAB);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint8_t* at = &data[kStep * i];
    std::memcpy(at, &points[i].x, 12);
    std::memcpy(at + 16, &points[i].intensity, 4);
    std::memcpy(at + 20, &points[i].t, 4);
    std::memcpy(at + 24, &points[i].ring, 2);
  }
  writer.bytes(data);
  writer.number(std::uint8_t{1});
  return writer.done();
}

inline std::vector<std::uint8_t> made_imu(Time stamp, const Eigen::Vector3d& acceleration,
                                          const Eigen::Vector3d& rate, Encoding encoding,
                                          const std::string& frame = "imu") {
  MessageWriter writer(encoding);
  writer.header(stamp, frame);
  for (int i = 0; i < 4 + 9; ++i) writer.number(i == 3 ? 1.0 : 0.0);
  writer.vector(rate);
  for (int i = 0; i < 9; ++i) writer.number(0.0);
  writer.vector(acceleration);
  for (int i = 0; i < 9; ++i) writer.number(0.0);
  return writer.done();
}

/// One transform, turned about z by a quarter: child x is parent y.
inline std::vector<std::uint8_t> made_quarter_turn(const std::string& parent,
                                                   const std::string& child, Encoding encoding) {
  MessageWriter writer(encoding);
  writer.number(std::uint32_t{1});
  writer.header(0, parent);
  writer.text(child);
  writer.vector({1, 2, 3});
  for (const double q : {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)}) writer.number(q);
  return writer.done();
}

/// What is written into a file of messages.
struct MadeMessage {
  std::string topic, type;  ///< "sensor_msgs/PointCloud2"
  Time received = 0;
  std::vector<std::uint8_t> bytes;
};

inline constexpr Time kDriveBegin = 1'700'000'000 * kNanosecondsPerSecond;

/// A scan of 400 points on 16 rings that takes a tenth of a second.
inline std::vector<MadePoint> made_points(int scan) {
  std::vector<MadePoint> points;
  for (int i = 0; i < 400; ++i) {
    const auto step = static_cast<float>(i);
    points.push_back({2 + 0.1F * step, -3, 0.5F * static_cast<float>(scan), step / 2,
                      static_cast<std::uint32_t>(i) * 249'000U,
                      static_cast<std::uint16_t>(i % 16)});
  }
  return points;
}

/// Clouds of made_points at 10 Hz, inertial samples at 100 Hz.
inline std::vector<MadeMessage> made_drive(int scans, Encoding encoding) {
  std::vector<MadeMessage> messages;
  for (int scan = 0; scan < scans; ++scan) {
    const Time begin = kDriveBegin + scan * 100'000'000LL;
    for (int i = 0; i < 10; ++i) {
      const Time stamp = begin + i * 10'000'000LL;
      messages.push_back(
          {"/imu/data", "sensor_msgs/Imu", stamp,
           made_imu(stamp, {0.1 * i, 0.2, 9.8}, {0.01, 0.02, 0.1 * scan}, encoding)});
    }
    messages.push_back({"/points", "sensor_msgs/PointCloud2", begin + 100'000'000,
                        made_cloud(made_points(scan), begin, encoding)});
  }
  return messages;
}

}  // namespace saker::lidar::testing
