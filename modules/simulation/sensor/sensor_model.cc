#include "saker/simulation/sensor/sensor_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/sensor/sensor_tables.h"

namespace saker::simulation {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kNoiseSpread = 1.0;  ///< ln of a unit's noise over its sheet's, at most
constexpr double kBiasSpread = 1.4;   ///< the same of what one beam's ranges are off by

/// Of 10 % reflectivity four beams of five answer at the range that a sheet says of it.
double sensitivity(double range_at_tenth_m) {
  return 0.1 / (1.6 * range_at_tenth_m * range_at_tenth_m);
}

ReceiverConfig receiver(double min_m, double max_m, double noise_m, double divergence_mrad,
                        double range_at_tenth_m) {
  ReceiverConfig c;
  c.min_range_m = min_m;
  c.max_range_m = max_m;
  c.noise_m = noise_m;
  c.beam_bias_m = 0.5 * noise_m;
  c.divergence_mrad = divergence_mrad;
  c.sensitivity = sensitivity(range_at_tenth_m);
  return c;
}

/// Ouster, "OS0", "OS1" and "OS2 Datasheet" (revision 7): field of view, origin of the beams,
/// ranges.
SensorModel ouster(const std::string& line, int rows, double half_angle_deg, double origin_m,
                   const ReceiverConfig& r, double weight) {
  SensorModel m;
  m.name = line + "-" + std::to_string(rows);
  m.beams = even_beams(rows, half_angle_deg, -half_angle_deg);
  m.columns = {512, 1024, 1024, 2048};
  m.receiver = r;
  m.range_step_m = 0.003;
  m.elevation_sd_deg = half_angle_deg / 450;
  m.azimuth_sd_deg = 0.05;
  m.ouster_origin_m = origin_m;
  m.weight = weight;
  return m;
}

SensorModel model(const std::string& name, std::vector<BeamAngle> beams, std::vector<int> columns,
                  double rate_hz, const ReceiverConfig& r, double range_step_m, double weight) {
  SensorModel m;
  m.name = name;
  m.beams = std::move(beams);
  m.columns = std::move(columns);
  m.rate_hz = rate_hz;
  m.receiver = r;
  m.range_step_m = range_step_m;
  m.weight = weight;
  return m;
}

void add_ouster(std::vector<SensorModel>& models) {
  const ReceiverConfig os0 = receiver(0.3, 75, 0.015, 2.6, 35);
  ReceiverConfig os1;
  const ReceiverConfig os2 = receiver(1.0, 240, 0.02, 0.7, 200);
  for (const int rows : {32, 64, 128}) models.push_back(ouster("OS0", rows, 45, 0.02767, os0, 1));
  for (const int rows : {16, 32, 64, 128})
    models.push_back(ouster("OS1", rows, 22.5, 0.015806, os1, rows == 64 ? 2.5 : 1));
  for (const int rows : {64, 128}) models.push_back(ouster("OS2", rows, 11.25, 0.013762, os2, 1));
}

/// Velodyne's user manuals of each: angles, columns at 10 Hz (20 Hz of the HDL-32E, as it is mostly
/// recorded), accuracy, ranges, spread of the beam.
void add_velodyne(std::vector<SensorModel>& models) {
  models.push_back(model("HDL-32E", even_beams(32, 10.67, -30.67), {1084, 1084, 2170}, 20,
                         receiver(1.0, 100, 0.015, 1.3, 70), 0.002, 2));
  models.push_back(model("HDL-64E", hdl64_angles(), {2045}, 10, hdl64_receiver(), 0.002, 3));
  models.push_back(model("VLP-16", even_beams(16, 15, -15), {900, 1800}, 10,
                         receiver(0.5, 100, 0.015, 1.2, 70), 0.002, 1));
  const ReceiverConfig vlp32 = receiver(1.0, 200, 0.015, 1.2, 110);
  models.push_back(model("VLP-32C", vlp32c_angles(), {1800}, 10, vlp32, 0.004, 1.5));
  models.push_back(model("VLS-128", vls128_angles(), {1800}, 10,
                         receiver(0.5, 245, 0.015, 1.0, 220), 0.004, 1.5));
}

/// Hesai's user manuals of each.
void add_hesai(std::vector<SensorModel>& models) {
  const ReceiverConfig far = receiver(0.3, 200, 0.015, 0.8, 180);
  models.push_back(model("Pandar40", pandar40_angles(), {1800}, 10, far, 0.004, 0.7));
  models.push_back(model("Pandar40P", pandar40p_angles(), {1800}, 10, far, 0.004, 1.3));
  models.push_back(model("Pandar64", pandar64_angles(), {1800}, 10, far, 0.004, 2.5));
  models.push_back(model("Pandar128", pandar128_angles(), {1800}, 10, far, 0.004, 1.5));
  models.push_back(model("XT32", even_beams(32, 15, -16), {2000}, 10,
                         receiver(0.05, 120, 0.008, 0.5, 80), 0.004, 1));
  models.push_back(
      model("QT64", qt64_angles(), {600}, 10, receiver(0.1, 60, 0.015, 2.0, 20), 0.004, 1));
}

std::vector<SensorModel> all_models() {
  std::vector<SensorModel> models;
  add_ouster(models);
  add_velodyne(models);
  add_hesai(models);
  SensorModel pair = models[static_cast<std::size_t>(SensorChoice::vlp_32c) - 1];
  pair.name = "VLP-32Cx2";
  pair.parts = 2;
  pair.weight = 2.5;
  models.push_back(pair);
  return models;
}

/// The beams of this unit: calibration moves each, and all together.
std::vector<BeamAngle> calibrated(const SensorModel& m, core::Rng& rng) {
  const double offset = rng.normal(0, 0.06);
  const double stretch = rng.normal(1, 0.003);
  std::vector<BeamAngle> beams = m.beams;
  for (BeamAngle& beam : beams) {
    beam.elevation_deg = stretch * beam.elevation_deg + offset + rng.normal(0, m.elevation_sd_deg);
    beam.azimuth_deg += rng.normal(0, m.azimuth_sd_deg);
  }
  std::sort(beams.begin(), beams.end(), [](const BeamAngle& a, const BeamAngle& b) {
    return a.elevation_deg > b.elevation_deg;
  });
  return beams;
}

BeamTable turning(const std::vector<BeamAngle>& beams, int columns, core::Rng& rng) {
  BeamTable table;
  table.rows = static_cast<int>(beams.size());
  table.columns = columns;
  const double first = rng.uniform(0, 2 * std::numbers::pi);
  for (const BeamAngle& beam : beams) {
    const double up = beam.elevation_deg * kDegree;
    for (int column = 0; column < columns; ++column) {
      const double turned =
          first - beam.azimuth_deg * kDegree - 2 * std::numbers::pi * column / columns;
      table.origins.emplace_back(0, 0, 0);
      table.directions.push_back(Eigen::Vector3d(std::cos(turned) * std::cos(up),
                                                 std::sin(turned) * std::cos(up), std::sin(up))
                                     .cast<float>());
    }
  }
  return table;
}

/// The vendor's formula with this line's angles. Its four columns of emitters stand by the ratio
/// of the fields of view of the lines.
BeamTable ouster_table(const SensorModel& m, int columns, core::Rng& rng) {
  const auto rows = static_cast<int>(m.beams.size());
  auto info = lidar::SensorInfo::make_os1(rows, columns, lidar::PacketProfile::kLegacy);
  const double ratio = m.beams.front().elevation_deg / info.beam_altitude_deg.front();
  const std::vector<BeamAngle> beams = calibrated(m, rng);
  for (std::size_t row = 0; row < beams.size(); ++row) {
    info.beam_altitude_deg[row] = beams[row].elevation_deg;
    info.beam_azimuth_deg[row] = ratio * info.beam_azimuth_deg[row] + beams[row].azimuth_deg;
  }
  info.beam_origin_m = m.ouster_origin_m;
  return ouster_beams(info);
}

BeamTable one_sensor(const SensorModel& m, int columns, core::Rng& rng) {
  if (m.name == "HDL-64E") return hdl64_beams(rng);
  if (m.ouster_origin_m > 0) return ouster_table(m, columns, rng);
  return turning(calibrated(m, rng), columns, rng);
}

void move_beams(BeamTable& table, const Eigen::Isometry3f& T) {
  for (Eigen::Vector3f& origin : table.origins) origin = T * origin;
  for (Eigen::Vector3f& direction : table.directions) direction = T.linear() * direction;
}

/// What this unit's ranges scatter by: those of units of one type differ by several times, and the
/// calibration between beams may be worse than the scatter of each.
void vary_noise(ReceiverConfig& receiver, core::Rng& rng) {
  receiver.noise_m *= std::exp(rng.uniform(-kNoiseSpread, kNoiseSpread));
  receiver.beam_bias_m *= std::exp(rng.uniform(-kNoiseSpread, kBiasSpread));
}

/// Where the lower one is: a hand's breadth below, often upside down (as Argoverse 2's is).
Eigen::Isometry3f T_upper_lower(core::Rng& rng) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const double over = rng.chance(0.6) ? std::numbers::pi : 0;
  T.linear() = (Eigen::AngleAxisd(rng.uniform(-std::numbers::pi, std::numbers::pi),
                                  Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(over + rng.normal(0, 0.015), Eigen::Vector3d::UnitX()) *
                Eigen::AngleAxisd(rng.normal(0, 0.015), Eigen::Vector3d::UnitY()))
                   .toRotationMatrix();
  T.translation() << rng.normal(0, 0.02), rng.normal(0, 0.02), -rng.uniform(0.06, 0.3);
  return T.cast<float>();
}

/// Rows of both, the highest beam of the cloud first.
BeamTable merged(const BeamTable& upper, const BeamTable& lower, std::vector<int>& part_of_row) {
  std::vector<std::pair<float, int>> rows;
  const auto mean_height = [](const BeamTable& table, int row) {
    float sum = 0;
    for (int column = 0; column < table.columns; ++column)
      sum += std::asin(table.directions[table.index(row, column)].z());
    return sum / static_cast<float>(table.columns);
  };
  for (int row = 0; row < upper.rows; ++row) rows.emplace_back(-mean_height(upper, row), row);
  for (int row = 0; row < lower.rows; ++row)
    rows.emplace_back(-mean_height(lower, row), upper.rows + row);
  std::sort(rows.begin(), rows.end());
  BeamTable both;
  both.rows = upper.rows + lower.rows;
  both.columns = upper.columns;
  for (const auto& [height, row] : rows) {
    const BeamTable& from = row < upper.rows ? upper : lower;
    part_of_row.push_back(row < upper.rows ? 0 : 1);
    const auto begin = static_cast<std::ptrdiff_t>(from.index(row % upper.rows, 0));
    both.origins.insert(both.origins.end(), from.origins.begin() + begin,
                        from.origins.begin() + begin + from.columns);
    both.directions.insert(both.directions.end(), from.directions.begin() + begin,
                           from.directions.begin() + begin + from.columns);
  }
  return both;
}

}  // namespace

const std::vector<SensorModel>& sensor_models() {
  static const std::vector<SensorModel> models = all_models();
  return models;
}

const SensorModel& sensor_model(SensorChoice choice) {
  return sensor_models().at(static_cast<std::size_t>(choice) - 1);
}

SensorChoice any_sensor(SensorChoice choice, core::Rng& rng) {
  if (choice != SensorChoice::mixed) return choice;
  const std::vector<SensorModel>& models = sensor_models();
  double left = 0;
  for (const SensorModel& m : models) left += m.weight;
  left *= rng.uniform();
  for (std::size_t i = 0; i < models.size(); ++i) {
    left -= models[i].weight;
    if (left < 0) return static_cast<SensorChoice>(i + 1);
  }
  return SensorChoice::os1_64;
}

SensorUnit make_unit(SensorChoice choice, core::Rng& rng) {
  const SensorModel& m = sensor_model(choice);
  SensorUnit unit;
  unit.name = m.name;
  unit.receiver = m.receiver;
  vary_noise(unit.receiver, rng);
  unit.range_step_m = m.range_step_m;
  unit.period_s = 1 / m.rate_hz;
  const int columns =
      m.columns[static_cast<std::size_t>(rng.index(static_cast<int>(m.columns.size())))];
  unit.beams = one_sensor(m, columns, rng);
  if (m.parts == 2) {
    BeamTable lower = one_sensor(m, columns, rng);
    move_beams(lower, T_upper_lower(rng));
    unit.beams = merged(unit.beams, lower, unit.part_of_row);
  } else {
    unit.part_of_row.assign(static_cast<std::size_t>(unit.beams.rows), 0);
  }
  return unit;
}

}  // namespace saker::simulation
