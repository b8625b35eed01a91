#pragma once

#include <optional>

#include "saker/exchange/coded.h"
#include "saker/objects/measurement.h"

/// A measurement in about thirty bytes, as part of a packed history (packed_history.h has the
/// steps).
namespace saker::exchange {

/// Whether it can be packed: finite, within 100 km, of a table of so many classes.
[[nodiscard]] bool packable(const objects::Measurement& measurement, int classes);

/// \param stamp  of the entry that it belongs to, whole µs
void pack(const objects::Measurement& measurement, Time stamp, CodedWriter& out);

/// Nothing where the bytes are none.
[[nodiscard]] std::optional<objects::Measurement> unpacked_measurement(Time stamp, int classes,
                                                                       CodedReader& in);

// Numbers in steps, shared with the history's poses.

constexpr Time kStampStep = 1000;                     // ns
constexpr double kPlaceStep = 1e-3;                   // m
constexpr double kAngleStep = 1.7453292519943295e-4;  // rad, 0.01°
constexpr double kFarthest = 1e5;                     // m

/// What the numbers in a message belong to: they are coded by what stood there before.
enum class Part : unsigned { entry, motion, measurement, classes, model, rest, covariance };
/// \param flags  of a measurement: others have other numbers
[[nodiscard]] constexpr unsigned part(Part which, unsigned flags = 0) {
  return static_cast<unsigned>(which) << 8 | flags;
}

/// Rounded down to a whole µs.
[[nodiscard]] Time to_step(Time stamp);
void pack_steps(double value, double step, CodedWriter& out);
void pack_steps(const Eigen::Vector3d& value, double step, CodedWriter& out);
/// Nothing where a number's size is above `most`.
[[nodiscard]] std::optional<Eigen::Vector3d> unpacked_steps(double step, double most,
                                                            CodedReader& in);

}  // namespace saker::exchange
