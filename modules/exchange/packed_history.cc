#include "saker/exchange/packed_history.h"

#include <bit>
#include <cmath>

#include "saker/exchange/bytes.h"
#include "saker/exchange/packed_covariance.h"
#include "saker/exchange/packed_measurement.h"
#include "saker/exchange/stream.h"

namespace saker::exchange {
namespace {

constexpr std::uint8_t kVersion = 3;
constexpr int kMostClasses = 256;
constexpr std::size_t kMostMeasurements = 5000;         // of one entry: an object map makes one
constexpr Time kMostStamp = 9'000'000'000'000'000'000;  // ns
constexpr double kMostTurn = 4;                         // rad, of a rotation vector

/// The pose that many steps after another: both ends compute it from the same whole numbers.
SE3 moved(const SE3& T, const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation) {
  SE3 motion = SE3::Identity();
  motion.translation() = translation;
  motion.linear() = core::so3_exp(rotation);
  return T * motion;
}

Eigen::Vector3d in_steps(const Eigen::Vector3d& value, double step) {
  return value.unaryExpr(
      [step](double v) { return static_cast<double>(std::llround(v / step)) * step; });
}

/// As the other end will read it.
SE3 pack_motion(const SE3& from, const SE3& to, CodedWriter& out) {
  const SE3 motion = from.inverse() * to;
  const Eigen::Vector3d translation = motion.translation(),
                        rotation = core::so3_log(motion.rotation());
  pack_steps(translation, kPlaceStep, out);
  pack_steps(rotation, kAngleStep, out);
  return moved(from, in_steps(translation, kPlaceStep), in_steps(rotation, kAngleStep));
}

bool has_covariance(const Matrix6d& covariance) {
  return covariance.allFinite() && covariance.diagonal().minCoeff() >= 0;
}

void pack_numbers(const Vector6d& numbers, ByteWriter& out) {
  for (const double number : numbers)
    out.fixed(std::bit_cast<std::uint32_t>(static_cast<float>(number)));
}

Vector6d unpack_numbers(ByteReader& in) {
  Vector6d numbers;
  for (double& number : numbers)
    number = static_cast<double>(std::bit_cast<float>(in.fixed<std::uint32_t>()));
  return numbers;
}

/// Whether there is one comes first.
void pack_takeoff(const std::optional<slam::PosePrior>& takeoff, ByteWriter& out) {
  out.byte(takeoff ? 1 : 0);
  if (!takeoff) return;
  pack_numbers(core::se3_log(takeoff->pose), out);
  pack_numbers(takeoff->covariance.diagonal(), out);
}

/// False where it is none.
bool unpack_takeoff(ByteReader& in, std::optional<slam::PosePrior>& takeoff) {
  if (in.byte() == 0) return true;
  const Vector6d pose = unpack_numbers(in), variances = unpack_numbers(in);
  if (!pose.allFinite() || pose.head<3>().norm() > kMostTurn ||
      pose.cwiseAbs().maxCoeff() > kFarthest) {
    return false;
  }
  if (!variances.allFinite() || variances.minCoeff() <= 0) return false;
  takeoff = slam::PosePrior{core::se3_exp(pose), variances.asDiagonal()};
  return true;
}

/// What an entry is read after.
struct Before {
  Time stamp = 0;
  SE3 T_odom_lidar = SE3::Identity();
};

std::optional<slam::HistoryEntry> unpacked_entry(const Before& before, int classes,
                                                 CodedReader in) {
  slam::HistoryEntry entry;
  in.part(part(Part::entry));
  const std::int64_t steps = in.signed_varint();
  if (steps < 0 || steps > (kMostStamp - before.stamp) / kStampStep) return std::nullopt;
  entry.stamp = before.stamp + steps * kStampStep;
  const auto translation = unpacked_steps(kPlaceStep, kFarthest, in);
  const auto rotation = unpacked_steps(kAngleStep, kMostTurn, in);
  if (!translation || !rotation) return std::nullopt;
  entry.T_odom_lidar = moved(before.T_odom_lidar, *translation, *rotation);
  const bool covariance = in.byte() != 0;
  const std::uint64_t measurements = in.varint();
  if (in.failed() || measurements > kMostMeasurements) return std::nullopt;
  in.part(part(Part::motion));
  if (covariance) entry.motion_covariance = unpacked_covariance(6, in);
  for (std::uint64_t i = 0; i < measurements; ++i) {
    auto measurement = unpacked_measurement(entry.stamp, classes, in);
    if (!measurement) return std::nullopt;
    entry.measurements.push_back(std::move(*measurement));
  }
  if (!in.done()) return std::nullopt;
  return entry;
}

}  // namespace

HistoryPacker::HistoryPacker(const std::string& robot, std::uint32_t flight, int classes,
                             const std::optional<slam::PosePrior>& takeoff)
    : robot_(robot), flight_(flight), classes_(classes), takeoff_(takeoff) {}

std::string HistoryPacker::header() const {
  ByteWriter out;
  out.byte(kVersion);
  out.text(robot_);
  out.varint(flight_);
  out.varint(static_cast<std::uint64_t>(classes_));
  pack_takeoff(takeoff_, out);
  return out.bytes();
}

std::string HistoryPacker::pack(const slam::HistoryEntry& entry) {
  const Time stamp = to_step(entry.stamp);
  const bool is_pose =
      entry.T_odom_lidar.matrix().allFinite() &&
      (T_odom_lidar_.inverse() * entry.T_odom_lidar).translation().cwiseAbs().maxCoeff() <
          kFarthest;
  if (!is_pose || stamp < stamp_ || stamp > kMostStamp) return "";
  std::vector<const objects::Measurement*> measurements;
  for (const objects::Measurement& each : entry.measurements) {
    if (packable(each, classes_) && measurements.size() < kMostMeasurements) {
      measurements.push_back(&each);
    }
  }
  left_out_ += static_cast<long>(entry.measurements.size() - measurements.size());
  CodedWriter body(statistics_);
  body.part(part(Part::entry));
  body.signed_varint((stamp - stamp_) / kStampStep);
  T_odom_lidar_ = pack_motion(T_odom_lidar_, entry.T_odom_lidar, body);
  stamp_ = stamp;
  const bool covariance = has_covariance(entry.motion_covariance);
  body.byte(covariance ? 1 : 0);
  body.varint(measurements.size());
  body.part(part(Part::motion));
  if (covariance) exchange::pack(entry.motion_covariance, body);
  for (const objects::Measurement* each : measurements) exchange::pack(*each, stamp, body);
  ByteWriter out;
  out.text(body.finish());
  return out.bytes();
}

std::string packed(const slam::History& history, int classes,
                   const std::optional<slam::PosePrior>& takeoff) {
  HistoryPacker packer(history.robot, history.flight, classes, takeoff);
  std::string bytes = packer.header();
  for (const slam::HistoryEntry& entry : history.entries) bytes += packer.pack(entry);
  return bytes;
}

std::optional<UnpackedHistory> unpacked(std::string_view bytes) {
  ByteReader in(bytes);
  UnpackedHistory result;
  const std::uint8_t version = in.byte();
  result.history.robot = in.text();
  result.history.flight = static_cast<std::uint32_t>(in.varint());
  const std::uint64_t classes = in.varint();
  const bool header = version == kVersion && unpack_takeoff(in, result.takeoff) && !in.failed() &&
                      is_name(result.history.robot) && classes > 0 && classes <= kMostClasses;
  if (!header) return std::nullopt;
  result.classes = static_cast<int>(classes);
  Before before;
  Statistics statistics;
  for (result.bytes = in.at(); in.rest() > 0; result.bytes = in.at()) {
    const std::string_view body = in.text();
    if (in.failed()) break;
    auto entry = unpacked_entry(before, result.classes, {body, statistics});
    if (!entry) break;
    before = {entry->stamp, entry->T_odom_lidar};
    result.history.entries.push_back(std::move(*entry));
  }
  return result;
}

}  // namespace saker::exchange
