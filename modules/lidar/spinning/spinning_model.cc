#include "saker/lidar/spinning/spinning_model.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>

namespace saker::lidar {
namespace {

using Angles = std::span<const double>;

constexpr std::array kVlp16Elevations = {-15., 1., -13., 3.,  -11., 5.,  -9., 7.,
                                         -7.,  9., -5.,  11., -3.,  13., -1., 15.};
constexpr std::array kVlp16HiResElevations = {-10., 0.6667, -8.6667, 2., -7.3333, 3.3333,
                                              -6.,  4.6667, -4.6667, 6., -3.3333, 7.3333,
                                              -2.,  8.6667, -0.6667, 10.};
constexpr std::array kVlp32cElevations = {
    -25.,   -1.,    -1.667, -15.639, -11.31, 0.,     -0.667, -8.843, -7.254, 0.333,  -0.333,
    -6.148, -5.333, 1.333,  0.667,   -4.,    -4.667, 1.667,  1.,     -3.667, -3.333, 3.333,
    2.333,  -2.667, -3.,    7.,      4.667,  -2.333, -2.,    15.,    10.333, -1.333};
constexpr std::array kVlp32cAzimuths = {
    1.4, -4.2, 1.4, -1.4, 1.4, -1.4, 4.2, -1.4, 1.4, -4.2, 1.4, -1.4, 4.2, -1.4, 4.2, -1.4,
    1.4, -4.2, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4, 1.4, -1.4, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4};
constexpr std::array kHdl32eElevations = {
    -30.67, -9.33,  -29.33, -8.,    -28.,   -6.67, -26.67, -5.33,  -25.33, -4.,    -24.,
    -2.67,  -22.67, -1.33,  -21.33, 0.,     -20.,  1.33,   -18.67, 2.67,   -17.33, 4.,
    -16.,   5.33,   -14.67, 6.67,   -13.33, 8.,    -12.,   9.33,   -10.67, 10.67};

constexpr std::array kPandar64Elevations = {
    14.708, 10.858, 7.885,   4.883,   2.866,  1.854,   1.686,   1.514,   1.348,  1.177,  1.01,
    0.839,  0.672,  0.501,   0.334,   0.163,  -0.005,  -0.174,  -0.343,  -0.511, -0.682, -0.849,
    -1.019, -1.187, -1.358,  -1.525,  -1.696, -1.862,  -2.034,  -2.202,  -2.372, -2.539, -2.71,
    -2.874, -3.047, -3.214,  -3.384,  -3.549, -3.722,  -3.886,  -4.058,  -4.224, -4.395, -4.559,
    -4.732, -4.894, -5.066,  -5.231,  -5.403, -5.565,  -5.739,  -5.9,    -6.072, -6.235, -7.237,
    -8.233, -9.234, -10.059, -11.206, -12.18, -13.148, -14.104, -19.063, -25.071};
/// Of channel 1 to 64, µs; all before the block's time.
constexpr std::array kPandar64Firings = {
    -23.18,  -21.876, -20.572, -19.268, -17.964, -16.66,  -11.444, -46.796, -7.532,  -36.956,
    -50.732, -54.668, -40.892, -44.828, -31.052, -34.988, -48.764, -52.7,   -38.924, -42.86,
    -29.084, -33.02,  -46.796, -25.148, -36.956, -50.732, -27.116, -40.892, -44.828, -31.052,
    -34.988, -48.764, -25.148, -38.924, -42.86,  -29.084, -33.02,  -52.7,   -6.228,  -54.668,
    -15.356, -27.116, -10.14,  -23.18,  -4.924,  -21.876, -14.052, -17.964, -8.836,  -19.268,
    -3.62,   -20.572, -12.748, -16.66,  -7.532,  -11.444, -6.228,  -15.356, -10.14,  -4.924,
    -3.62,   -14.052, -8.836,  -12.748};
constexpr std::array kQt64Elevations = {
    -52.121, -49.785, -47.577, -45.477, -43.465, -41.528, -39.653, -37.831, -36.055, -34.32,
    -32.619, -30.95,  -29.308, -27.69,  -26.094, -24.517, -22.964, -21.42,  -19.889, -18.372,
    -16.865, -15.368, -13.88,  -12.399, -10.925, -9.457,  -7.994,  -6.535,  -5.079,  -3.626,
    -2.175,  -0.725,  0.725,   2.175,   3.626,   5.079,   6.534,   7.993,   9.456,   10.923,
    12.397,  13.877,  15.365,  16.861,  18.368,  19.885,  21.415,  22.959,  24.524,  26.101,
    27.697,  29.315,  30.957,  32.627,  34.328,  36.064,  37.84,   39.662,  41.537,  43.475,
    45.487,  47.587,  49.795,  52.133};
constexpr std::array kQt64Azimuths = {
    8.736,  8.314,  7.964,  7.669,  7.417,  7.198,  7.007,  6.838,  6.688,  6.554,  6.434,
    6.326,  6.228,  6.14,   6.059,  5.987,  -5.27,  -5.216, -5.167, -5.123, -5.083, -5.047,
    -5.016, -4.988, -4.963, -4.942, -4.924, -4.91,  -4.898, -4.889, -4.884, -4.881, 5.493,
    5.496,  5.502,  5.512,  5.525,  5.541,  5.561,  5.584,  5.611,  5.642,  5.676,  5.716,
    5.759,  5.808,  5.862,  5.921,  -5.33,  -5.396, -5.469, -5.55,  -5.64,  -5.74,  -5.85,
    -5.974, -6.113, -6.269, -6.447, -6.651, -6.887, -7.163, -7.493, -7.892};
/// Of channel 1 to 64, µs.
constexpr std::array kQt64Firings = {
    2.31,  4.37,   6.43,   8.49,   10.54,  12.6,   14.66,  16.71,  19.16,  21.22,  23.28,
    25.34, 27.39,  29.45,  31.5,   33.56,  36.61,  38.67,  40.73,  42.78,  44.84,  46.9,
    48.95, 51.01,  53.45,  55.52,  57.58,  59.63,  61.69,  63.74,  65.8,   67.86,  70.9,
    72.97, 75.02,  77.08,  79.14,  81.19,  83.25,  85.3,   87.75,  89.82,  91.87,  93.93,
    95.98, 98.04,  100.1,  102.15, 105.2,  107.26, 109.32, 111.38, 113.43, 115.49, 117.54,
    119.6, 122.05, 124.11, 126.17, 128.22, 130.28, 132.34, 134.39, 136.45};

/// Beams that fire one after another, `together` at a time.
std::vector<SpinningBeam> in_turn(Angles elevations, double step_us, std::size_t together = 1,
                                  double first_us = 0) {
  std::vector<SpinningBeam> beams(elevations.size());
  for (std::size_t i = 0; i < beams.size(); ++i) {
    beams[i].elevation_deg = elevations[i];
    beams[i].firing_us = first_us + step_us * static_cast<double>(i / together);
  }
  return beams;
}

/// A block of a VLP-16 holds two turns of its sixteen beams.
std::vector<SpinningBeam> twice(std::vector<SpinningBeam> beams, double turn_us) {
  const std::size_t once = beams.size();
  for (std::size_t i = 0; i < once; ++i) {
    beams.push_back(beams[i]);
    beams.back().firing_us += turn_us;
  }
  return beams;
}

/// Channels 7 to 54 look aside in a cycle of six; the others all to one side.
double pandar64_azimuth(std::size_t channel) {
  constexpr std::array kCycle = {1.042, 3.125, 5.208, -5.208, -3.125, -1.042};
  constexpr std::size_t kFirst = 6, kEnd = 54;
  if (channel < kFirst || channel >= kEnd) return -1.042;
  return kCycle[(channel - kFirst) % kCycle.size()];
}

std::vector<SpinningBeam> pandar64() {
  std::vector<SpinningBeam> beams = in_turn(kPandar64Elevations, 0);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    beams[i].azimuth_deg = pandar64_azimuth(i);
    beams[i].firing_us = kPandar64Firings[i];
  }
  return beams;
}

std::vector<SpinningBeam> qt64() {
  std::vector<SpinningBeam> beams = in_turn(kQt64Elevations, 0);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    beams[i].azimuth_deg = kQt64Azimuths[i];
    beams[i].firing_us = kQt64Firings[i];
  }
  return beams;
}

std::vector<SpinningBeam> vlp32c() {
  std::vector<SpinningBeam> beams = in_turn(kVlp32cElevations, 2.304, 2);
  for (std::size_t i = 0; i < beams.size(); ++i) beams[i].azimuth_deg = kVlp32cAzimuths[i];
  return beams;
}

/// 32 beams from 15° down to −16°.
std::vector<SpinningBeam> xt32() {
  std::array<double, 32> elevations;
  for (std::size_t i = 0; i < elevations.size(); ++i) elevations[i] = 15. - static_cast<double>(i);
  return in_turn(elevations, 1.512, 1, 6);
}

SpinningModel model_without_rings(SpinningKind kind) {
  using enum SpinningKind;
  switch (kind) {
    case kVlp16:
      return {kind, "VLP-16", twice(in_turn(kVlp16Elevations, 2.304), 55.296)};
    case kVlp16HiRes:
      return {kind, "VLP-16 Hi-Res", twice(in_turn(kVlp16HiResElevations, 2.304), 55.296)};
    case kVlp32c:
      return {kind, "VLP-32C", vlp32c()};
    case kHdl32e:
      return {kind, "HDL-32E", in_turn(kHdl32eElevations, 1.152)};
    case kHdl64e:
      return {kind, "HDL-64E", std::vector<SpinningBeam>(64), true};
    case kPandar64:
      return {kind, "Pandar64", pandar64()};
    case kXt32:
      return {kind, "PandarXT-32", xt32()};
    case kQt64:
      return {kind, "PandarQT", qt64()};
  }
  return {};
}

}  // namespace

double spinning_block_us(SpinningKind kind) {
  using enum SpinningKind;
  switch (kind) {
    case kVlp16:
    case kVlp16HiRes:
      return 110.592;
    case kVlp32c:
      return 55.296;
    case kHdl32e:
      return 46.08;
    case kHdl64e:
      return 48;  // of a pair: six in 288 µs
    case kPandar64:
      return 55.56;
    case kXt32:
      return 50;
    case kQt64:
      return 166.67;
  }
  return 0;
}

void number_rings(std::vector<SpinningBeam>& beams) {
  std::set<double> elevations;
  for (const SpinningBeam& beam : beams) elevations.insert(beam.elevation_deg);
  for (SpinningBeam& beam : beams) {
    beam.ring = static_cast<std::uint16_t>(
        std::distance(elevations.begin(), elevations.find(beam.elevation_deg)));
  }
}

SpinningModel spinning_model(SpinningKind kind) {
  SpinningModel model = model_without_rings(kind);
  number_rings(model.beams);
  return model;
}

}  // namespace saker::lidar
