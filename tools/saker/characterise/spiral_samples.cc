#include "tools/saker/characterise/spiral_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "saker/autonomy/lockstep.h"

namespace saker::tools {
namespace {

std::vector<KnownObject> known_objects(const simulation::World& world,
                                       const objects::ClassTable& table) {
  std::vector<KnownObject> known;
  for (std::size_t i = 0; i < world.objects.size(); ++i) {
    const simulation::TrueObject& object = world.objects[i];
    if (object.moving) continue;
    known.push_back(
        {static_cast<int>(i + 1), object.kind, table.find(object.class_name), object.model});
  }
  return known;
}

/// Of a cuboid its centre, of a cylinder what detection looks at.
Eigen::Vector3d middle_of(const objects::Model& model) {
  constexpr double kStem = 1.2;  // m
  if (const auto* cylinder = std::get_if<objects::Cylinder>(&model)) {
    return cylinder->root + std::min(kStem, 0.5 * cylinder->height) * cylinder->axis;
  }
  return objects::place(model);
}

bool in_view(const lidar::SensorInfo& sensor, const Eigen::Vector3d& p_lidar) {
  const double altitude_deg =
      std::atan2(p_lidar.z(), p_lidar.head<2>().norm()) * 180 / std::numbers::pi;
  return altitude_deg <= sensor.beam_altitude_deg.front() &&
         altitude_deg >= sensor.beam_altitude_deg.back();
}

/// Hears the detections of a flight.
class Listener : public autonomy::LockstepObserver {
 public:
  Listener(const simulation::SpiralFlight& flight, const objects::ClassTable& table, double range,
           std::string recording)
      : flight_(flight),
        objects_(known_objects(flight.world(), table)),
        range_(range),
        recording_(std::move(recording)) {}

  void on_scan(const autonomy::ScanRecord&, const odometry::OdometryEstimate&) override {}

  void on_detections(const objects::Detections& detections) override {
    const SE3 T_sim_lidar = flight_.T_sim_lidar(detections.stamp);
    const double time_s = to_seconds(detections.stamp - flight_.start());
    const std::vector<int> objects = matched(detections.measurements, T_sim_lidar, objects_);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (objects[i] < 0) continue;
      const uncertainty::Sample sample =
          sample_of_known(detections.measurements[i], T_sim_lidar,
                          objects_[static_cast<std::size_t>(objects[i])], recording_, time_s);
      if (sample.view.range <= range_) result_.samples.push_back(sample);
    }
    for (std::size_t k = 0; k < objects_.size(); ++k) {
      const bool detected = std::ranges::count(objects, static_cast<int>(k)) > 0;
      glance(objects_[k], detections.stamp, detected);
    }
  }

  [[nodiscard]] SpiralSamples result() && { return std::move(result_); }

 private:
  void glance(const KnownObject& object, Time stamp, bool detected) {
    const SE3 T_sim_lidar = flight_.T_sim_lidar(stamp);
    const uncertainty::View view = uncertainty::view_of(T_sim_lidar.translation(), object.model);
    const bool visible = in_view(flight_.sensor(), T_sim_lidar.inverse() * middle_of(object.model));
    if (view.range > range_ || !(visible || detected)) return;
    const int returns = flight_.returns(stamp, static_cast<simulation::ObjectId>(object.id));
    result_.glances.push_back({recording_, object.id, object.kind, object.class_id,
                               to_seconds(stamp - flight_.start()), view, returns, detected});
  }

  const simulation::SpiralFlight& flight_;
  std::vector<KnownObject> objects_;
  double range_;
  std::string recording_;
  SpiralSamples result_;
};

}  // namespace

SpiralSamples fly_spiral(const simulation::SpiralConfig& spiral,
                         const simulation::SpiralSubject& subject, std::uint64_t seed,
                         const autonomy::Config& config, const std::string& recording) {
  simulation::SpiralFlight flight(spiral, subject, seed);
  autonomy::Config as_in_flight = config;
  as_in_flight.rates.segmentation_hz = config.rates.flight_segmentation_hz;
  // A model fitted to what a model had corrected would feed on itself.
  as_in_flight.slam.measurement_noise = slam::NoiseSource::fixed;
  core::Timings timings;
  autonomy::Lockstep lockstep(as_in_flight, 1, timings);
  Listener listener(flight, config.objects, config.detection.window.range_m, recording);
  (void)lockstep.run(flight, listener);
  return std::move(listener).result();
}

std::string glances_text(const std::vector<Glance>& glances, const objects::ClassTable& table) {
  std::string text =
      "recording,object_id,kind,class,time_s,range,angle,elevation,returns,detected\n";
  for (const Glance& g : glances) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", g.recording, g.object_id, g.kind,
                        table[g.class_id].name, g.time_s, g.view.range, g.view.angle,
                        g.view.elevation, g.returns, g.detected ? 1 : 0);
  }
  return text;
}

}  // namespace saker::tools
