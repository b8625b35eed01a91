#include "saker/exchange/packed_measurement.h"

#include <algorithm>
#include <cmath>

#include "saker/exchange/packed_covariance.h"

namespace saker::exchange {
namespace {

using objects::Cuboid;
using objects::Cylinder;
using objects::Measurement;

// What the first byte says.
enum Flag : unsigned {
  kCylinder = 1,
  kMoving = 2,
  kReflectivity = 4,
  kLengthSd = 8,
  kCovariance = 16,
  kViewCell = 32,
  kOtherStamp = 64,
};

constexpr double kSizeStep = 1e-2;      // m
constexpr double kAxisStep = 1e-3;      // of a unit vector's component
constexpr double kLogOddsStep = 0.125;  // nat
constexpr double kMostLogOdds = 100;    // nat
constexpr double kMostSize = 1e3;       // m
constexpr double kProbabilitySteps = 64;
constexpr double kReflectivitySteps = 255;
constexpr double kMostAngle = 4;  // rad, of a rotation vector

int rows_of(bool cylinder) { return cylinder ? 6 : 9; }

bool is_size(double metres) { return metres >= 0 && metres <= kMostSize; }

bool packable(const Cuboid& cuboid) {
  return cuboid.pose.matrix().allFinite() &&
         cuboid.pose.translation().cwiseAbs().maxCoeff() < kFarthest &&
         std::all_of(cuboid.size.begin(), cuboid.size.end(), is_size);
}

bool packable(const Cylinder& cylinder) {
  return cylinder.root.allFinite() && cylinder.axis.allFinite() &&
         cylinder.root.cwiseAbs().maxCoeff() < kFarthest &&
         std::abs(cylinder.axis.norm() - 1) < kAxisStep && is_size(cylinder.radius) &&
         is_size(cylinder.height);
}

void pack(const Cuboid& cuboid, CodedWriter& out) {
  pack_steps(cuboid.pose.translation(), kPlaceStep, out);
  pack_steps(core::so3_log(cuboid.pose.rotation()), kAngleStep, out);
  pack_steps(cuboid.size, kSizeStep, out);
}

void pack(const Cylinder& cylinder, CodedWriter& out) {
  pack_steps(cylinder.root, kPlaceStep, out);
  pack_steps(cylinder.axis, kAxisStep, out);
  pack_steps(cylinder.radius, kPlaceStep, out);
  pack_steps(cylinder.height, kSizeStep, out);
}

/// A number of steps; nothing where the size is above `most`.
std::optional<double> unpacked_number(double step, double most, CodedReader& in) {
  const double value = static_cast<double>(in.signed_varint()) * step;
  if (in.failed() || !(std::abs(value) <= most)) return std::nullopt;
  return value;
}

std::optional<Cuboid> unpacked_cuboid(CodedReader& in) {
  const auto place = unpacked_steps(kPlaceStep, kFarthest, in);
  const auto rotation = unpacked_steps(kAngleStep, kMostAngle, in);
  const auto size = unpacked_steps(kSizeStep, kMostSize, in);
  if (!place || !rotation || !size || size->minCoeff() < 0) return std::nullopt;
  Cuboid cuboid;
  cuboid.pose.linear() = core::so3_exp(*rotation);
  cuboid.pose.translation() = *place;
  cuboid.size = *size;
  return cuboid;
}

std::optional<Cylinder> unpacked_cylinder(CodedReader& in) {
  const auto root = unpacked_steps(kPlaceStep, kFarthest, in);
  const auto axis = unpacked_steps(kAxisStep, 1, in);
  const auto radius = unpacked_number(kPlaceStep, kMostSize, in);
  const auto height = unpacked_number(kSizeStep, kMostSize, in);
  if (!root || !axis || !radius || !height || *radius < 0 || *height < 0) return std::nullopt;
  if (axis->norm() < 0.5) return std::nullopt;  // no unit vector, however rounded
  return Cylinder{*root, axis->normalized(), *radius, *height};
}

/// Which classes have any, a bit each; then a byte for each of these.
void pack_probabilities(const Measurement& measurement, CodedWriter& out) {
  std::vector<std::uint8_t> steps;
  for (const double p : measurement.class_probability) {
    steps.push_back(static_cast<std::uint8_t>(std::lround(p * kProbabilitySteps)));
  }
  for (std::size_t first = 0; first < steps.size(); first += 8) {
    unsigned mask = 0;
    for (std::size_t i = first; i < std::min(first + 8, steps.size()); ++i) {
      mask |= (steps[i] > 0 ? 1U : 0U) << (i - first);
    }
    out.byte(static_cast<std::uint8_t>(mask));
  }
  for (const std::uint8_t s : steps) {
    if (s > 0) out.byte(s);
  }
}

std::vector<double> unpacked_probabilities(int classes, CodedReader& in) {
  std::vector<double> probability(static_cast<std::size_t>(classes), 0.0);
  std::vector<bool> any;
  for (std::size_t first = 0; first < probability.size(); first += 8) {
    const unsigned mask = in.byte();
    for (unsigned bit = 0; bit < 8; ++bit) any.push_back((mask >> bit & 1) != 0);
  }
  double sum = 0;
  for (std::size_t i = 0; i < probability.size(); ++i) {
    if (any[i]) sum += probability[i] = in.byte();
  }
  for (double& p : probability) p /= sum;  // NaN where there is none: the caller looks
  return probability;
}

unsigned flags_of(const Measurement& m, Time stamp) {
  return (std::holds_alternative<Cylinder>(m.model) ? kCylinder : 0U) | (m.moving ? kMoving : 0U) |
         (std::isfinite(m.reflectivity) ? kReflectivity : 0U) |
         (m.length_sd > 0 && std::isfinite(m.length_sd) ? kLengthSd : 0U) |
         (m.covariance.size() > 0 ? kCovariance : 0U) | (m.view_cell >= 0 ? kViewCell : 0U) |
         (to_step(m.stamp) != stamp ? kOtherStamp : 0U);
}

/// What is there of a measurement beside model and classes.
bool read_rest(unsigned flags, CodedReader& in, Measurement& m) {
  in.part(part(Part::rest, flags));
  const std::uint64_t points = in.varint();
  const auto log_odds = unpacked_number(kLogOddsStep, kMostLogOdds, in);
  const std::uint64_t cell = (flags & kViewCell) != 0 ? in.varint() : 0;
  constexpr std::uint64_t kMostInt = 0x7FFFFFFF;
  if (!log_odds || points > kMostInt || cell > kMostInt) return false;
  m.points = static_cast<int>(points);
  m.front_log_odds = *log_odds;
  m.moving = (flags & kMoving) != 0;
  if ((flags & kViewCell) != 0) m.view_cell = static_cast<int>(cell);
  if ((flags & kReflectivity) != 0) m.reflectivity = in.byte() / kReflectivitySteps;
  if ((flags & kLengthSd) != 0) m.length_sd = unpacked_sd(in.byte());
  in.part(part(Part::covariance, flags));
  if ((flags & kCovariance) != 0) {
    m.covariance = unpacked_covariance(rows_of((flags & kCylinder) != 0), in);
  }
  return !in.failed();
}

}  // namespace

Time to_step(Time stamp) {
  const Time rest = stamp % kStampStep;
  return stamp - (rest < 0 ? rest + kStampStep : rest);
}

void pack_steps(double value, double step, CodedWriter& out) {
  out.signed_varint(std::llround(value / step));
}

void pack_steps(const Eigen::Vector3d& value, double step, CodedWriter& out) {
  for (const double v : value) pack_steps(v, step, out);
}

std::optional<Eigen::Vector3d> unpacked_steps(double step, double most, CodedReader& in) {
  Eigen::Vector3d value;
  for (double& v : value) {
    const auto number = unpacked_number(step, most, in);
    if (!number) return std::nullopt;
    v = *number;
  }
  return value;
}

bool packable(const Measurement& m, int classes) {
  const auto is_probability = [](double p) { return p >= 0 && p <= 1; };
  const auto& p = m.class_probability;
  const Eigen::Index rows = rows_of(std::holds_alternative<Cylinder>(m.model));
  const bool covariance = m.covariance.size() == 0 ||
                          (m.covariance.rows() == rows && m.covariance.cols() == rows &&
                           m.covariance.allFinite() && m.covariance.diagonal().minCoeff() > 0);
  return covariance && static_cast<int>(p.size()) == classes && m.class_id < classes &&
         std::all_of(p.begin(), p.end(), is_probability) &&
         p[m.class_id] * kProbabilitySteps >= 1 && std::abs(m.front_log_odds) < kMostLogOdds &&
         m.points >= 0 && std::visit([](const auto& model) { return packable(model); }, m.model);
}

void pack(const Measurement& m, Time stamp, CodedWriter& out) {
  const unsigned flags = flags_of(m, stamp);
  out.part(part(Part::measurement));
  out.byte(static_cast<std::uint8_t>(flags));
  out.part(part(Part::classes, flags));
  if ((flags & kOtherStamp) != 0) out.signed_varint((to_step(m.stamp) - stamp) / kStampStep);
  out.byte(m.class_id);
  pack_probabilities(m, out);
  out.part(part(Part::model, flags));
  std::visit([&out](const auto& model) { pack(model, out); }, m.model);
  out.part(part(Part::rest, flags));
  out.varint(static_cast<std::uint64_t>(m.points));
  pack_steps(m.front_log_odds, kLogOddsStep, out);
  if ((flags & kViewCell) != 0) out.varint(static_cast<std::uint64_t>(m.view_cell));
  if ((flags & kReflectivity) != 0) {
    out.byte(static_cast<std::uint8_t>(
        std::lround(std::clamp(m.reflectivity, 0.0, 1.0) * kReflectivitySteps)));
  }
  if ((flags & kLengthSd) != 0) out.byte(packed_sd(m.length_sd));
  out.part(part(Part::covariance, flags));
  if ((flags & kCovariance) != 0) pack(m.covariance, out);
}

std::optional<Measurement> unpacked_measurement(Time stamp, int classes, CodedReader& in) {
  constexpr double kMostStampSteps = 1e9;  // a measurement is of its entry's time, give or take
  in.part(part(Part::measurement));
  const unsigned flags = in.byte();
  in.part(part(Part::classes, flags));
  Measurement m;
  m.stamp = stamp;
  if ((flags & kOtherStamp) != 0) {
    const auto steps = unpacked_number(1, kMostStampSteps, in);
    if (!steps) return std::nullopt;
    m.stamp += static_cast<Time>(*steps) * kStampStep;
  }
  m.class_id = in.byte();
  m.class_probability = unpacked_probabilities(classes, in);
  if (m.class_id >= classes || !(m.class_probability[m.class_id] > 0)) return std::nullopt;
  const bool cylinder = (flags & kCylinder) != 0;
  in.part(part(Part::model, flags));
  const auto model = cylinder ? std::optional<objects::Model>(unpacked_cylinder(in))
                              : std::optional<objects::Model>(unpacked_cuboid(in));
  if (!model) return std::nullopt;
  m.model = *model;
  if (!read_rest(flags, in, m)) return std::nullopt;
  return m;
}

}  // namespace saker::exchange
