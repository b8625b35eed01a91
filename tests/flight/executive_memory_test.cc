#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "flight/executive/guidance_loop.h"
#include "flight/executive/safety_loop.h"
#include "tests/flight/counted_memory.h"

/// Guidance and safety allocate nothing in flight: their loops' bodies with all that they call, and
/// LCM over UDP where there is a network (in a namespace of its own). What the others say is made
/// between the runs, and not counted. The clock is set by hand.
namespace saker::flight {
namespace {

using autonomy::MissionPhase;
using autonomy::PlanningOrder;

constexpr Time kStep = kNanosecondsPerSecond / 50;

/// How often `make` allocates; what it makes is given to somebody, so that it has to be made.
template <class Make>
long counted(const Make& make) {
  const long before = allocations();
  const auto made = make();
  const long after = allocations();
  [[maybe_unused]] const void* volatile kept = &*made;
  return after - before;
}

TEST(CountedMemory, SeesEveryWayToAllocate) {
  const auto allocated = [] {
    return std::unique_ptr<void, void (*)(void*)>(std::malloc(10), &std::free);
  };
  EXPECT_EQ(counted([&] { return std::make_optional(allocated()); }), 1);
  EXPECT_EQ(counted([] { return std::make_unique<double>(1); }), 1);
  EXPECT_EQ(counted([] { return std::make_optional(std::string(100, 'x')); }), 1);
  EXPECT_EQ(counted([] { return std::make_unique<VehicleOdometry>(); }), 1);
  EXPECT_EQ(counted([] { return std::make_optional(1); }), 0);
}

/// A vehicle that does what it is told, all that safety listens to, and the two loops.
class ExecutiveMemory : public testing::Test {
 protected:
  ExecutiveMemory() : supervisor({}, {}, motion::Geofence(motion::GeofenceConfig{})) {
    const char* network = std::getenv("SAKER_NAMESPACE");
    if (network != nullptr && std::string(network) == "yes") {
      bus.emplace(BusConfig{}, "R1");
    } else {
      network_missing = true;
      return;
    }
    board.marked = true;
    safety.emplace(SafetyParts{.step =
                                   [this](autonomy::SupervisorInput input) {
                                     auto output = supervisor.step(std::move(input));
                                     if (output.command) command = *output.command;
                                     return output;
                                   },
                               .mission_done = [this] { return supervisor.mission().done(); },
                               .land_ordered = [] { return false; },
                               .has_targets = true},
                   board, *bus);
    guidance.emplace(autonomy::GuidanceConfig{}, board, *bus);
  }
  void SetUp() override {
    if (network_missing) GTEST_SKIP() << "runs in a namespace with a route";
  }

  /// Both loops once; what they allocated is added up.
  void step() {
    now += kStep;
    tell();
    const long before = allocations();
    (void)safety->run();
    (void)guidance->run();
    allocated += allocations() - before;
    while (auto event = board.events.pop()) events.push_back(*event);
    obey();
  }
  void fly(double seconds) {
    for (const Time end = now + from_seconds(seconds); now < end;) step();
  }
  bool fly_to(MissionPhase phase, double seconds = 40) {
    for (const Time end = now + from_seconds(seconds); now < end && this->phase() != phase;) step();
    return this->phase() == phase;
  }
  MissionPhase phase() const { return supervisor.mission().phase(); }

  void tell() {
    // A clock never jumps: a new one shows what is said here.
    std::destroy_at(&board.clock);
    std::construct_at(&board.clock);
    board.clock.hear(now);
    const Time seen = board.clock.now();
    vehicle.stamp = odometry.stamp = seen;
    vehicle.battery_share = battery;
    odometry.status = VehicleOdometryStatus::ok;
    board.vehicle.put(vehicle);
    board.odometry.put(odometry);
    board.map_news.put({seen, SE3::Identity(), 0.5});
    board.newest_grid = board.newest_scan = board.newest_registered = seen;
    report.stamp = seen;
    report.column.state = autonomy::TakeoffColumn::State::free;
    board.report.put(report);
    if (!checker_hangs) say_verdict(seen);
  }
  void say_verdict(Time seen) {
    motion::Verdict verdict;
    verdict.stamp = seen;
    const auto committed = board.committed.latest();
    verdict.trajectory_id = committed ? committed->id : 0;
    verdict.clear = true;
    board.verdict.put(verdict);
  }
  void obey() {
    const auto setpoint = board.setpoint.latest();
    if (setpoint) odometry.T_odom_body.translation() = setpoint->position;
    if (!setpoint && phase() == MissionPhase::takeoff)
      odometry.T_odom_body.translation().z() += 0.05;
    if (command.id == acknowledged) return;
    acknowledged = command.id;
    board.acks.push({now, command.id, true, "a reason that does not fit into a short string"});
    vehicle.armed = true;
  }
  /// 20 m along x.
  void propose() {
    autonomy::Planning::Output plan;
    plan.proposal.emplace();
    const auto committed = board.committed.latest();
    plan.proposal->from_id = committed->id;
    plan.proposal->trajectory.start = board.clock.now() + from_seconds(0.3);
    plan.proposal->trajectory.step_s = 0.05;
    const Eigen::Vector3d from = committed->states.back().position;
    for (int i = 0; i <= 400; ++i) {
      plan.proposal->trajectory.states.push_back({from + Eigen::Vector3d(0.05 * i, 0, 0),
                                                  Eigen::Vector3d(1, 0, 0), Eigen::Vector3d::Zero(),
                                                  0, 0});
    }
    plans.push_back(std::make_shared<const autonomy::Planning::Output>(std::move(plan)));
    board.plan.put(plans.back());
  }
  bool moves() const {
    const auto setpoint = board.setpoint.latest();
    return setpoint && setpoint->velocity.norm() > 0.5;
  }

  bool network_missing = false;
  std::optional<Bus> bus;
  Blackboard board;
  autonomy::Supervisor supervisor;
  std::optional<SafetyLoop> safety;
  std::optional<GuidanceLoop> guidance;
  Time now = 100 * kNanosecondsPerSecond;
  VehicleState vehicle;
  VehicleOdometry odometry;
  double battery = 0.9;
  autonomy::PlanningReport report;
  bool checker_hangs = false;
  Command command;  // the newest
  std::int64_t acknowledged = 0;
  std::vector<std::shared_ptr<const autonomy::Planning::Output>> plans;
  std::vector<autonomy::MissionEvent> events;
  long allocated = 0;
};

TEST_F(ExecutiveMemory, NothingIsAllocatedFromTheTourToTheGround) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  fly(1);  // warm
  allocated = 0;
  propose();
  fly(2);
  EXPECT_TRUE(moves());
  EXPECT_EQ(allocated, 0) << "following";

  checker_hangs = true;
  fly(3);
  EXPECT_EQ(phase(), MissionPhase::hold);
  EXPECT_FALSE(moves());
  EXPECT_EQ(allocated, 0) << "a stop, and a hold";

  checker_hangs = false;
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  propose();
  fly(1);
  EXPECT_TRUE(moves());
  EXPECT_EQ(allocated, 0) << "another way";

  report.text = "a long text of planning, as it says when a target cannot be reached from here";
  battery = 0.25;
  report.order = PlanningOrder::home;
  fly(1);
  EXPECT_EQ(phase(), MissionPhase::return_home);
  EXPECT_EQ(allocated, 0) << "the way home";

  battery = 0.1;
  fly(5);
  EXPECT_EQ(phase(), MissionPhase::landing);
  EXPECT_EQ(allocated, 0) << "a landing";
  vehicle.armed = false;
  fly(0.5);
  EXPECT_EQ(phase(), MissionPhase::done);
  EXPECT_GT(events.size(), 7U);
}

TEST_F(ExecutiveMemory, NothingIsAllocatedWhileSomebodyElseFliesAndMuchIsWrong) {
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  fly(1);
  allocated = 0;
  vehicle.faults = kTakenOver;
  checker_hangs = true;
  battery = 0.1;
  fly(2);
  EXPECT_TRUE(supervisor.mission().taken_over());
  EXPECT_EQ(allocated, 0);
}

TEST_F(ExecutiveMemory, NothingIsAllocatedOnTheWayUp) {
  ASSERT_TRUE(fly_to(MissionPhase::takeoff));
  allocated = 0;
  ASSERT_TRUE(fly_to(MissionPhase::tour));
  EXPECT_EQ(allocated, 0);
}

}  // namespace
}  // namespace saker::flight
