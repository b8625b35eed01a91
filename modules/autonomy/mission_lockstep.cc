#include "saker/autonomy/mission_lockstep.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "saker/core/error.h"
#include "saker/lidar/imu_packet.h"

namespace saker::autonomy {
namespace {

constexpr Time kTick = kNanosecondsPerSecond / 100;  // the rate of `_ODOMETRY`

Time after(Time now, double seconds) { return now + from_seconds(seconds); }

}  // namespace

MissionLockstep::MissionLockstep(const Config& config, const lidar::SensorInfo& sensor,
                                 const objects::ObjectMap& prior, SteppedPlant& plant,
                                 SteppedChecker& checker, int threads, core::Timings& timings)
    : config_(config),
      timings_(timings),
      plant_(plant),
      checker_(checker),
      gate_(sensor, {.address = {}, .offset = Time{0}}),  // the plant's time is the sensor's
      ingestion_(config.odometry, config.standstill, sensor, lidar::mount_pose(config.mount)),
      body_pose_(config.body_pose, config.odometry.motion.inertial,
                 lidar::mount_pose(config.mount)),
      contact_(config.contact, lidar::mount_pose(config.mount)),
      window_(config.detection.window_s),
      uncertainty_(uncertainty_for(config)),
      mapping_(config.detection, config.slam, config.objects, uncertainty_),
      planning_(config.planning, active_as_flown(config, sensor), config.motion, config.objects,
                prior, config.mission.height_m, uncertainty_),
      guidance_(config.guidance),
      supervisor_(config.safety, config.mission, planning_.geofence()),
      sensor_(sensor),
      segmentation_schedule_(config.rates.flight_segmentation_hz),
      slam_schedule_(config.rates.slam_hz),
      planning_schedule_(config.planning.rate_hz),
      pool_(threads - 1, [this] {
        return std::make_unique<segmentation::Segmentation>(config_.segmentation, config_.objects,
                                                            up_as_mounted(config_));
      }) {
  const LatencyConfig latency = core::checked(config.latency, "latency");
  if (latency.planning_s >= config.planning.horizon_s) {
    throw Error(fmt::format("latency.planning_s: {:g}, expected less than planning.horizon_s, {:g}",
                            latency.planning_s, config.planning.horizon_s));
  }
}

MissionLockstep::~MissionLockstep() = default;

MissionResult MissionLockstep::run(double limit_s, MissionObserver& observer) {
  observer_ = &observer;
  // Room from the start: a list that doubles in flight holds three times its size for a moment.
  result_.scans.reserve(static_cast<std::size_t>(std::ceil(limit_s * sensor_.frame_rate_hz)));
  const Time end = after(plant_.now(), limit_s);
  for (Time now = plant_.now() + kTick; now <= end && !supervisor_.mission().done(); now += kTick) {
    step(now);
  }
  observer_ = nullptr;
  return finish();
}

void MissionLockstep::step(Time now) {
  timings_.time("plant", [&] { plant_.step_to(now); });
  receive(now);
  ingest(now);
  map(now);
  check();
  timings_.time("checker", [&] { checker_.step_to(now); });
  plan(now);
  odometry_ = body_pose_.at(now);
  plant_.send(odometry_);
  odd_tick_ = !odd_tick_;
  if (odd_tick_) return;
  supervise(now);
  guide(now);
}

void MissionLockstep::receive(Time now) {
  for (SensorPacket& packet : plant_.take_packets()) {
    gate_.pass(packet.payload, {}, packet.received,
               [&](const std::vector<std::uint8_t>& payload, Time) { take_packet(payload, now); });
  }
  if (const auto state = plant_.take_state()) {
    vehicle_ = *state;
    heard_.vehicle = now;
  }
  for (CommandAck& ack : plant_.take_acks()) acks_.push_back(std::move(ack));
}

void MissionLockstep::take_packet(const std::vector<std::uint8_t>& payload, Time now) {
  for (const lidar::ImuSample& sample : lidar::decode_imu(payload, sensor_)) {
    body_pose_.add(sample, now);
    contact_.add(sample);
  }
  ingestion_.add(payload);
}

/// When what a stage begins now is there.
Time MissionLockstep::due(Stage stage, double latency_s, Time now) const {
  return after(now, latency_s + (delays_ != nullptr ? delays_->extra_s(stage, now) : 0));
}

void MissionLockstep::ingest(Time now) {
  if (auto frame = ingestion_.take_newest()) {
    scans_.push(
        due(Stage::registration, config_.latency.odometry_s, now),
        timings_.time("odometry", [&] { return ingestion_.register_scan(std::move(*frame)); }));
  }
  heard_.lidar = ingestion_.newest_stamp();
  while (const auto scan = scans_.take(now)) take_scan(*scan, now);
}

void MissionLockstep::take_scan(const IngestedScan& scan, Time now) {
  const RegisteredScan& registered = scan.registered;
  result_.scans.push_back(
      {scan.name, registered.stamp, registered.T_odom_lidar, scan.status, scan.reason, ""});
  ++result_.counters.scans;
  observer_->on_scan(scan);
  if (scan.status == odometry::OdometryStatus::refused) return;
  motion_log_.add(registered.stamp, registered.T_odom_lidar, scan.covariance);
  if (!odometry::registered(scan.status)) {
    ++result_.counters.scans_not_registered;
    return;
  }
  result_.counters.scans_not_held += scan.status == odometry::OdometryStatus::open;
  heard_.odometry = registered.stamp;
  body_pose_.correct(registered.stamp, registered.T_odom_lidar, scan.covariance);
  timings_.time("checker", [&] { checker_.send(registered); });
  if (segmentation_schedule_.due(registered.stamp)) segment(scan, now);
}

void MissionLockstep::segment(const IngestedScan& scan, Time now) {
  auto labels = pool_.submit([this, raw = scan.scan](segmentation::Segmentation& segmentation) {
    return timings_.time("segmentation", [&] {
      return std::make_shared<const lidar::Labels>(segmentation.segment(*raw));
    });
  });
  labels_.push(due(Stage::segmentation, config_.latency.segmentation_s, now),
               {scan.registered, std::move(labels)});
  ++result_.counters.labelled_scans;
}

void MissionLockstep::map(Time now) {
  while (const auto labelled = labels_.take(now)) {
    const RegisteredScan& scan = labelled->registered;
    window_.add(
        {scan.stamp, scan.T_odom_lidar, scan.points, labelled->labels.get(), scan.reflectivity});
    if (!slam_schedule_.due(scan.stamp)) continue;
    if (last_map_.valid()) last_map_.wait();  // one cycle at a time
    last_map_ = pool_.submit([this, window = window_.scans(),
                              motion = motion_log_.take(scan.stamp)](segmentation::Segmentation&) {
      return timings_.time("mapping", [&] { return mapping_.cycle(window, motion); });
    });
    maps_.push(due(Stage::mapping, config_.latency.mapping_s, now), last_map_);
    ++result_.counters.slam_cycles;
  }
  while (const auto map = maps_.take(now)) {
    map_ = map->get();
    heard_.mapping = map_->stamp;
    observer_->on_map(*map_);
  }
}

void MissionLockstep::check() {
  if (const auto verdict = checker_.take_verdict()) {
    verdict_ = verdict;
    heard_.verdict = verdict->stamp;
  }
  if (auto grid = checker_.take_grid()) {
    heard_.occupancy = grid->stamp;
    grid_ = std::move(grid);
  }
}

void MissionLockstep::plan(Time now) {
  if (planning_schedule_.due(now)) {
    PlanningInput input{now,   orders_.planning,      odometry_, map_,
                        grid_, guidance_.committed(), verdict_};
    plans_.push(due(Stage::planning, config_.latency.planning_s, now),
                pool_.submit([this, input = std::move(input)](segmentation::Segmentation&) {
                  return timings_.time("planning", [&] {
                    return planning_.step(input,
                                          core::Budget::iterations(config_.planning.iterations));
                  });
                }));
  }
  while (const auto plan = plans_.take(now)) take_plan(plan->get(), now);
}

void MissionLockstep::take_plan(const Planning::Output& output, Time now) {
  heard_.planning = output.report.stamp;
  report_ = output.report;
  if (output.report.order == PlanningOrder::none) return;
  ++result_.counters.plans;
  const PlanningStatus status = output.report.status;
  result_.counters.refused_plans +=
      status == PlanningStatus::refused || status == PlanningStatus::gave_up;
  observer_->on_plan(output.report, output.plan);
  if (!output.proposal) return;
  if (guidance_.commit(*output.proposal, now) == CommitStatus::committed) {
    ++result_.counters.commits;
    send_trajectory();
  } else {
    ++result_.counters.refused_commits;
  }
}

void MissionLockstep::supervise(Time now) {
  SupervisorInput input;
  input.now = now;
  heard_.guidance = now;
  input.heard = heard_;
  input.vehicle = vehicle_;
  input.odometry = odometry_;
  if (map_) {
    input.T_world_odom = map_->T_world_odom;
    input.classified_share = map_->classified_share;
  }
  input.contact = contact_.last();
  input.setpoint = setpoint_;
  input.acks = std::exchange(acks_, {});
  input.planning = report_;
  input.stop = guidance_.last_stop();
  input.has_targets = !planning_.active().idle();
  input.orders = std::exchange(given_, {});
  const Mission::Output output = supervisor_.step(std::move(input));

  orders_ = output.orders;
  if (output.anchor) guidance_.anchor(now, odometry_);
  if (output.command) plant_.send(*output.command);
  for (const MissionEvent& event : output.events) {
    if (event.cause == Cause::armed) took_off_ = now;
    result_.events.push_back(event);
    observer_->on_event(event);
  }
  if (output.reply) observer_->on_reply(*output.reply);
  if (supervisor_.mission().done() && took_off_ != 0) {
    result_.flight_time_s = to_seconds(now - took_off_);
  }
}

void MissionLockstep::guide(Time now) {
  setpoint_ = guidance_.update(now, orders_.guidance, verdict_);
  send_trajectory();
  if (!setpoint_) return;
  plant_.send(*setpoint_);
  observer_->on_setpoint(*setpoint_, odometry_);
}

/// Whenever another one is flown.
void MissionLockstep::send_trajectory() {
  const auto& committed = guidance_.committed();
  if (committed == nullptr || committed->id == sent_trajectory_) return;
  sent_trajectory_ = committed->id;
  checker_.send(*committed);
}

MissionResult MissionLockstep::finish() {
  if (last_map_.valid()) last_map_.wait();
  const slam::Slam& slam = mapping_.slam();
  result_.targets = planning_.active().targets();
  result_.map = mapping_.map_with_covariance(result_.targets);
  result_.history = slam.history();
  for (std::size_t i = 0; i < result_.scans.size(); ++i) {
    const ScanRecord& scan = result_.scans[i];
    result_.T_world_lidar.push_back(slam.corrected(scan.stamp, scan.T_odom_lidar));
    if (i == 0) continue;
    const Eigen::Vector3d before = result_.scans[i - 1].T_odom_lidar.translation();
    result_.path_m += (scan.T_odom_lidar.translation() - before).norm();
  }
  const Mission& mission = supervisor_.mission();
  result_.succeeded = mission.succeeded();
  result_.phase = mission.phase();
  result_.outcome = mission.outcome();
  result_.counters.stops = guidance_.last_stop().count;
  return std::move(result_);
}

}  // namespace saker::autonomy
