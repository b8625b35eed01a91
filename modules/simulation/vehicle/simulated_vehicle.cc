#include "saker/simulation/vehicle/simulated_vehicle.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "saker/core/error.h"
#include "saker/lidar/imu_packet.h"
#include "saker/simulation/mission/capture_files.h"
#include "saker/simulation/mission/truth.h"

namespace saker::simulation {
namespace {

constexpr Time kStart = 1000 * kNanosecondsPerSecond;  ///< of the sensor's clock
constexpr int kTicksPerSecond = 1000;
constexpr Time kTick = kNanosecondsPerSecond / kTicksPerSecond;
constexpr double kTickSeconds = 1.0 / kTicksPerSecond;
constexpr std::size_t kRecentPoses = 64;
constexpr std::size_t kMostScans = 1000;
constexpr float kDeepest = 200;         ///< m below the vehicle where ground is looked for
constexpr double kHardTouchdown = 2.0;  ///< m/s: harder ones break something

double lowest_point(const World& world) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& vertex : world.mesh.vertices)
    lowest = std::min(lowest, static_cast<double>(vertex.z()));
  return lowest;
}

/// Ticks between two readings.
int period_of(double rate_hz, const std::string& key) {
  const int ticks = static_cast<int>(std::lround(kTicksPerSecond / rate_hz));
  if (std::abs(ticks * rate_hz - kTicksPerSecond) < 1e-6) return ticks;
  throw Error(key + ": " + std::to_string(rate_hz) + ", expected a divisor of 1000 Hz");
}

}  // namespace

SimulatedVehicle::SimulatedVehicle(const MissionConfig& config, std::uint64_t seed,
                                   const std::optional<TakeoffPlace>& place, std::uint64_t own_seed)
    : config_(core::checked(config, "mission")),
      site_(build_mission_world(config_, seed, place)),
      caster_(site_.world()),
      plain_m_(lowest_point(site_.world())),
      T_body_lidar_(lidar::mount_pose(config_.mount)),
      body_(config_.airframe, site_.T_sim_world),
      wind_(config_.wind, core::Rng(own_seed).fork(31)),
      barometer_(config_.barometer, core::Rng(own_seed).fork(32)),
      battery_(config_.battery),
      controller_imu_(config_.controller_imu, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(),
                      core::Rng(own_seed).fork(33)),
      lidar_imu_(config_.imu,
                 T_body_lidar_ * sensor_info(config_.capture).T_sensor_imu.translation(),
                 T_body_lidar_.linear().transpose(), core::Rng(own_seed).fork(34)),
      controller_(config_.controller, config_.airframe),
      contacts_(caster_, site_.world(), config_.airframe.radius_m),
      lidar_(config_, caster_, site_.world(), kStart, own_seed),
      controller_period_(
          period_of(config_.controller_imu.rate_hz, "mission.controller_imu.rate_hz")),
      lidar_imu_period_(period_of(config_.imu.rate_hz, "mission.imu.rate_hz")),
      start_(kStart),
      now_(kStart),
      events_(config_.events) {
  settle();
  recent_.emplace_back(now_, body_.state().pose);
}

/// On its legs, before time begins.
void SimulatedVehicle::settle() {
  probe_ground();
  for (int i = 0; i < kTicksPerSecond; ++i)
    body_.step(kTickSeconds, thrusts_, Eigen::Vector3d::Zero(), ground_);
}

void SimulatedVehicle::step_to(Time time) {
  while (now_ + kTick <= time) tick();
}

void SimulatedVehicle::tick() {
  body_.step(kTickSeconds, battery_.empty() ? MotorThrusts(MotorThrusts::Zero()) : thrusts_, air_,
             ground_);
  now_ += kTick;
  ++ticks_;
  battery_.drain(kTickSeconds, body_.thrusts());
  recent_.emplace_back(now_, body_.state().pose);
  if (recent_.size() > kRecentPoses) recent_.pop_front();
  if (!body_.on_ground()) {
    ++airborne_ticks_;
    path_m_ += kTickSeconds * body_.state().velocity.norm();
  }
  if (every(10)) at_100_hz();
  if (every(20)) at_50_hz();
  if (every(controller_period_)) fly();
  if (every(lidar_imu_period_)) send_imu();
  turn_lidar();
}

void SimulatedVehicle::fly() {
  thrusts_ = controller_.update(controller_imu_.sample(body_.state(), now_), barometer_m_,
                                battery_.share());
  barometer_m_.reset();
}

void SimulatedVehicle::send_imu() {
  const lidar::ImuSample sample = lidar_imu_.sample(body_.state(), now_);
  if (!lidar_on_) return;
  packets_.add({now_ + from_seconds(config_.latency_s), lidar_.info().imu_port,
                lidar::encode_imu(sample, lidar_.info())});
}

void SimulatedVehicle::at_100_hz() {
  air_ = wind_.step(10 * kTickSeconds);
  probe_ground();
}

void SimulatedVehicle::at_50_hz() {
  barometer_m_ = barometer_.read(body_.state().pose.translation().z(), 20 * kTickSeconds);
  watch_contacts();
  run_events();
  state_ = controller_.state();
}

/// What each foot would stand on: beyond the world's edge a plain.
void SimulatedVehicle::probe_ground() {
  std::array<Shot, 4> shots;
  const auto feet = body_.feet();
  const double from = body_.state().pose.translation().z();
  for (std::size_t i = 0; i < 4; ++i) {
    shots[i].origin = Eigen::Vector3d(feet[i].x(), feet[i].y(), from).cast<float>();
    shots[i].direction = -Eigen::Vector3f::UnitZ();
  }
  caster_.cast(shots, kDeepest);
  for (std::size_t i = 0; i < 4; ++i)
    ground_[i] = shots[i].hit ? from - shots[i].distance : plain_m_;
}

void SimulatedVehicle::watch_contacts() {
  const bool airborne = !body_.on_ground();
  if (airborne && took_off_ == 0) took_off_ = now_;
  if (airborne) contacts_.check(body_.state().pose.translation());
  if (was_airborne_ && !airborne && body_.touchdown_speed() > kHardTouchdown) ++crashes_;
  was_airborne_ = airborne;
}

/// The body's pose, between two ticks.
SE3 SimulatedVehicle::body_at(Time time) const {
  const auto after = std::lower_bound(recent_.begin(), recent_.end(), time,
                                      [](const auto& entry, Time t) { return entry.first < t; });
  if (after == recent_.begin()) return recent_.front().second;
  if (after == recent_.end()) return recent_.back().second;
  const auto& before = *std::prev(after);
  const double share = to_seconds(time - before.first) / to_seconds(after->first - before.first);
  return core::interpolate(before.second, after->second, share);
}

void SimulatedVehicle::turn_lidar() {
  DatagramQueue nowhere;
  while (lidar_.block_end() <= now_) {
    if (!site_.flight.drivers.empty()) drive(site_.flight, to_seconds(now_ - start_), caster_);
    if (!movers_.empty()) move_movers();
    const auto pose_at = [&](Time time) { return body_at(time) * T_body_lidar_; };
    if (!lidar_.turn(pose_at, lidar_on_ ? packets_ : nowhere)) continue;
    const Time stamp = lidar_.scan_stamp();
    scans_.push_back({stamp, T_world_sim() * pose_at(stamp)});
    if (scans_.size() > kMostScans) scans_.pop_front();
  }
}

std::optional<VehicleState> SimulatedVehicle::take_state() {
  return std::exchange(state_, std::nullopt);
}

std::vector<ScanTruth> SimulatedVehicle::take_scan_truth() {
  std::vector<ScanTruth> taken(scans_.begin(), scans_.end());
  scans_.clear();
  return taken;
}

void SimulatedVehicle::send(const VehicleOdometry& odometry) {
  if (!odometry_on_) return;
  if (!odometry_frozen_ || !last_odometry_) last_odometry_ = odometry;
  VehicleOdometry heard = *last_odometry_;
  heard.stamp = odometry.stamp;
  controller_.receive(heard);
}

VehicleTruth SimulatedVehicle::truth() const {
  VehicleTruth truth;
  truth.stamp = now_;
  truth.T_world_body = T_world_sim() * body_.state().pose;
  truth.velocity = T_world_sim().linear() * body_.state().velocity;
  truth.airborne = !body_.on_ground();
  truth.has_flown = took_off_ != 0;
  truth.collisions = contacts_.collisions() + crashes_;
  if (truth.has_flown)
    truth.min_clearance_m = std::min(contacts_.min_clearance(), CollisionMonitor::kReach);
  truth.nearest_label = contacts_.nearest_label();
  truth.flight_time_s = static_cast<double>(airborne_ticks_) * kTickSeconds;
  truth.path_m = path_m_;
  truth.events_begun = static_cast<int>(config_.events.size() - events_.size());
  return truth;
}

objects::ObjectMap SimulatedVehicle::true_map() const {
  return truth_map(site_.world(), T_world_sim(), lidar_.hits());
}

// Events.

void SimulatedVehicle::run_events() {
  if (gust_ends_ != 0 && now_ >= gust_ends_) {
    wind_.blow(Eigen::Vector3d::Zero());
    gust_ends_ = 0;
  }
  if (events_.empty()) return;
  const double flown = took_off_ == 0 ? -1 : to_seconds(now_ - took_off_);
  const double speed = body_.state().velocity.head<2>().norm();
  const auto due =
      std::stable_partition(events_.begin(), events_.end(), [&](const ScenarioEvent& event) {
        const double since = event.since_begin ? to_seconds(now_ - start_) : flown;
        return event.at_s > since || event.from_speed_mps > speed;
      });
  for (auto event = due; event != events_.end(); ++event) begin(*event);
  events_.erase(due, events_.end());
}

void SimulatedVehicle::begin(const ScenarioEvent& event) {
  switch (event.kind) {
    case ScenarioEventKind::obstacle:
      return insert_obstacle(event);
    case ScenarioEventKind::mover:
      return send_mover(event);
    case ScenarioEventKind::lidar_stop:
      lidar_on_ = false;
      return;
    case ScenarioEventKind::odometry_stop:
      odometry_on_ = false;
      return;
    case ScenarioEventKind::odometry_freeze:
      odometry_frozen_ = true;
      return;
    case ScenarioEventKind::gust: {
      const double towards = event.towards_deg * std::numbers::pi / 180;
      wind_.blow(site_.T_sim_world.linear() * event.gust_mps *
                 Eigen::Vector3d(std::cos(towards), std::sin(towards), 0));
      gust_ends_ = now_ + from_seconds(event.gust_s);
      return;
    }
  }
}

/// Across the direction of flight, or of the nose where it hovers.
void SimulatedVehicle::insert_obstacle(const ScenarioEvent& event) {
  constexpr double kMoving = 0.2;  // m/s
  const VehicleTruth is = truth();
  const bool moving = is.velocity.head<2>().norm() > kMoving;
  const double heading =
      moving ? std::atan2(is.velocity.y(), is.velocity.x()) : core::yaw(is.T_world_body.linear());
  Eigen::Vector2d place(event.x_m, event.y_m);
  if (event.ahead_m > 0)
    place = is.T_world_body.translation().head<2>() +
            event.ahead_m * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  const SE3 T = site_.T_sim_world * placed(place.x(), place.y(), 0, heading);
  caster_.move(site_.inserted[inserted_++], Eigen::Affine3d(T.matrix()).cast<float>());
}

/// Straight to where the vehicle is now, whatever stands between, and on.
void SimulatedVehicle::send_mover(const ScenarioEvent& event) {
  const double towards = event.towards_deg * std::numbers::pi / 180;
  const Eigen::Vector2d from =
      truth().T_world_body.translation().head<2>() -
      event.ahead_m * Eigen::Vector2d(std::cos(towards), std::sin(towards));
  const SE3 T = site_.T_sim_world * placed(from.x(), from.y(), 0, towards);
  movers_.push_back({site_.inserted[inserted_++], now_, T, event.mover_mps});
}

void SimulatedVehicle::move_movers() {
  for (const Mover& mover : movers_) {
    SE3 T = mover.T_sim_start;
    const double way_m = mover.speed_mps * to_seconds(now_ - mover.since);
    T.translation() += way_m * T.linear().col(0);
    caster_.move(mover.index, Eigen::Affine3d(T.matrix()).cast<float>());
  }
}

}  // namespace saker::simulation
