#include "faulty_flight.h"

#include <algorithm>
#include <utility>

#include "saker/lidar/imu_packet.h"
#include "saker/lidar/packet.h"

namespace saker::autonomy {
namespace {

constexpr double kTakeoff_s = 8;  // nothing is fast before
constexpr double kSlice_s = 2;    // of a run: each ends with the covariance of the map
constexpr double kMost_s = 40;    // until the fault
constexpr double kAtRest_mps = 0.2;
constexpr Time kRevolution = kNanosecondsPerSecond / 10;
constexpr Time kIntoRevolution = kNanosecondsPerSecond / 50;

simulation::MissionConfig scenario(std::vector<simulation::ScenarioEvent> events) {
  simulation::MissionConfig config;
  config.capture.rows = 32;
  config.capture.columns = 512;
  config.site.targets = 2;
  config.events = std::move(events);
  return config;
}

bool lands(const VehicleState& state) {
  return !state.armed || state.mode == VehicleMode::land || state.mode == VehicleMode::descend;
}

bool is_calm(const RecordedPlant::Row& row) {
  return row.speed() < kAtRest_mps || lands(row.state);
}

/// Keeps what happened over several slices of one run.
class Listener : public MissionObserver {
 public:
  Listener(std::vector<MissionEvent>& events, OrderReply& reply) : events_(events), reply_(reply) {}
  void on_event(const MissionEvent& event) override { events_.push_back(event); }
  void on_reply(const OrderReply& reply) override { reply_ = reply; }

 private:
  std::vector<MissionEvent>& events_;
  OrderReply& reply_;
};

}  // namespace

void RecordedPlant::step_to(Time time) {
  plant_.step_to(time);
  const simulation::VehicleTruth truth = vehicle_.truth();
  const VehicleState last = rows.empty() ? VehicleState{} : rows.back().state;
  rows.push_back({truth, last});
  if (watch) watch(truth);
}

std::vector<SensorPacket> RecordedPlant::take_packets() {
  auto packets = plant_.take_packets();
  if (link == Link::gone) packets.clear();
  if (link == Link::blind) {
    std::erase_if(packets, [](const SensorPacket& packet) {
      return packet.payload.size() != lidar::kImuPacketBytes;
    });
  }
  if (link == Link::covered) {
    for (SensorPacket& packet : packets) cover(packet);
  }
  if (!blow_mps2.isZero()) {
    for (SensorPacket& packet : packets) add_blow(packet);
  }
  return packets;
}

void RecordedPlant::cover(SensorPacket& packet) const {
  const lidar::PacketFormat format(vehicle_.sensor());
  if (packet.payload.size() != format.packet_bytes()) return;
  std::vector<lidar::Column> columns;
  for (int i = 0; i < format.columns_per_packet(); ++i) {
    columns.push_back(format.column(packet.payload, i));
    std::ranges::fill(columns.back().pixels, lidar::Pixel{});
  }
  packet.payload = format.encode(columns);
}

void RecordedPlant::add_blow(SensorPacket& packet) const {
  if (packet.payload.size() != lidar::kImuPacketBytes) return;
  for (lidar::ImuSample sample : lidar::decode_imu(packet.payload, vehicle_.sensor())) {
    sample.acceleration += blow_mps2;
    packet.payload = lidar::encode_imu(sample, vehicle_.sensor());
  }
}

std::optional<VehicleState> RecordedPlant::take_state() {
  const auto state = plant_.take_state();
  if (state && !rows.empty()) rows.back().state = *state;
  return link == Link::gone ? std::nullopt : state;
}

std::vector<CommandAck> RecordedPlant::take_acks() {
  auto acks = plant_.take_acks();
  if (link == Link::gone) acks.clear();
  return acks;
}

void RecordedPlant::send(const VehicleOdometry& odometry) {
  if (hears()) plant_.send(odometry);
}
void RecordedPlant::send(const Setpoint& setpoint) {
  if (hears()) plant_.send(setpoint);
}
void RecordedPlant::send(const Command& command) {
  if (hears()) plant_.send(command);
}

void MortalChecker::begin() {
  checker_.emplace(config_.local_checker, config_.collision_checker, config_.motion.clearance);
}

void MortalChecker::step_to(Time time) {
  if (checker_) checker_->step_to(time);
}
void MortalChecker::send(const RegisteredScan& scan) {
  if (checker_) checker_->send(scan);
}
void MortalChecker::send(const motion::Trajectory& trajectory) {
  if (checker_) checker_->send(trajectory);
}

std::optional<motion::Verdict> MortalChecker::take_verdict() {
  return checker_ ? checker_->take_verdict() : std::nullopt;
}

std::shared_ptr<const occupancy::OccupancyGrid> MortalChecker::take_grid() {
  return checker_ ? checker_->take_grid() : nullptr;
}

FaultyFlight::FaultyFlight(std::vector<simulation::ScenarioEvent> events)
    : vehicle_(scenario(std::move(events)), 1), plant(vehicle_), checker(config_) {
  const simulation::MissionFence& fence = vehicle_.site().fence;
  config_.active.policy = active::PolicyName::visit;
  config_.active.visit_policy.sides = 2;  // long legs
  config_.active.visit_policy.oblique_worth_m = 10;
  config_.motion.geofence = {fence.lowest_m, fence.highest_m, fence.polygon_m};
  mission_ = std::make_unique<MissionLockstep>(config_, vehicle_.sensor(), vehicle_.site().prior,
                                               plant, checker, 2, timings_);
}

bool FaultyFlight::fly_into(const std::function<bool(const simulation::VehicleTruth&)>& when,
                            const std::function<void()>& fault, double lasts_s,
                            const std::function<void()>& over) {
  plant.watch = [=, this, lasts = true](const simulation::VehicleTruth& truth) mutable {
    if (fault_ != 0 && lasts && to_seconds(truth.stamp - fault_) >= lasts_s) {
      lasts = false;
      over();
    }
    if (fault_ != 0 || !when(truth)) return;
    fault_ = truth.stamp;
    fault();
  };
  const Time end = plant.now() + from_seconds(kMost_s);
  go_on(kTakeoff_s);
  while (fault_ == 0 && plant.now() < end && result_.phase != MissionPhase::done) go_on(kSlice_s);
  return fault_ != 0;
}

bool FaultyFlight::fly_fast_into(const std::function<void()>& fault) {
  return fly_fast_into(fault, INFINITY, [] {});
}

bool FaultyFlight::fly_fast_into(const std::function<void()>& fault, double lasts_s,
                                 const std::function<void()>& over) {
  const auto fast = [](const simulation::VehicleTruth& truth) {
    return truth.velocity.head<2>().norm() > kFast;
  };
  return fly_into(fast, fault, lasts_s, over);
}

bool FaultyFlight::fly_into_gap_of_scans(double speed_mps, double lasts_s) {
  const auto when = [speed_mps](const simulation::VehicleTruth& truth) {
    return truth.velocity.head<2>().norm() > speed_mps &&
           truth.stamp % kRevolution == kIntoRevolution;
  };
  return fly_into(
      when, [this] { plant.link = RecordedPlant::Link::blind; }, lasts_s,
      [this] { plant.link = RecordedPlant::Link::up; });
}

bool FaultyFlight::fly_into_event() {
  return fly_into([](const simulation::VehicleTruth& truth) { return truth.events_begun > 0; },
                  [] {});
}

bool FaultyFlight::fly_into_moment(double flown_s, const std::function<void()>& fault) {
  return fly_into(
      [flown_s](const simulation::VehicleTruth& truth) { return truth.flight_time_s >= flown_s; },
      fault);
}

void FaultyFlight::go_on(double seconds) {
  Listener listener(events_, reply_);
  result_ = mission_->run(seconds, listener);
}

double FaultyFlight::settled_after() const {
  for (const RecordedPlant::Row& row : plant.rows) {
    if (row.truth.stamp > fault_ && is_calm(row)) return to_seconds(row.truth.stamp - fault_);
  }
  return INFINITY;
}

double FaultyFlight::settled_for_good_after() const {
  const auto last = std::find_if_not(plant.rows.rbegin(), plant.rows.rend(), is_calm);
  if (last == plant.rows.rbegin()) return INFINITY;
  return last == plant.rows.rend() ? 0 : to_seconds(last->truth.stamp - fault_);
}

double FaultyFlight::said_after(Cause cause) const {
  for (const MissionEvent& event : events_) {
    if (event.cause == cause && event.stamp >= fault_) return to_seconds(event.stamp - fault_);
  }
  return NAN;
}

bool FaultyFlight::flies_fast_again(double most_s) {
  const Time end = plant.now() + from_seconds(most_s);
  bool fast = false;
  plant.watch = [&](const simulation::VehicleTruth& truth) {
    fast = fast || truth.velocity.head<2>().norm() > kFast;
  };
  while (!fast && plant.now() < end && result_.phase != MissionPhase::done) go_on(kSlice_s);
  plant.watch = nullptr;
  return fast;
}

std::uint32_t FaultyFlight::faults() const {
  std::uint32_t faults = 0;
  for (const RecordedPlant::Row& row : plant.rows) {
    if (row.truth.stamp > fault_) faults |= row.state.faults;
  }
  return faults;
}

}  // namespace saker::autonomy
