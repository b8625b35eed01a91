#include "saker/autonomy/safety.h"

#include <gtest/gtest.h>

namespace saker::autonomy {
namespace {

constexpr Time kStep = kNanosecondsPerSecond / 50;

/// Flies where nothing is wrong.
SafetyInput good(Time now) {
  SafetyInput input;
  input.now = now;
  input.heard = {now, now, now, now, now, now, now, now};
  input.vehicle.stamp = now;
  input.vehicle.armed = true;
  input.vehicle.mode = VehicleMode::guided;
  input.vehicle.battery_share = 0.8;
  input.odometry.stamp = now;
  input.odometry.status = VehicleOdometryStatus::ok;
  input.odometry.T_odom_body.translation() = Eigen::Vector3d(1, 2, 3);
  input.place = {1, 2, 3};
  input.setpoint = Setpoint{};
  input.setpoint->position = {1, 2, 3};
  input.flying = true;
  input.planning_due = true;
  return input;
}

class SafetyTest : public testing::Test {
 protected:
  SafetyTest() : safety(config, motion::Geofence(motion::GeofenceConfig{})) {}

  /// Steps for so long with `spoil` at work; the last decision.
  template <class Spoil>
  SafetyDecision pass(double seconds, Spoil spoil) {
    SafetyDecision decision;
    for (const Time end = now + from_seconds(seconds); now < end; now += kStep) {
      SafetyInput input = good(now);
      spoil(input);
      decision = safety.update(input);
    }
    return decision;
  }

  const SafetyConfig config;
  Safety safety;
  Time now = 100 * kNanosecondsPerSecond;
};

const auto kNothing = [](SafetyInput&) {};

TEST_F(SafetyTest, SaysNothingWhereNothingIsWrong) {
  EXPECT_EQ(pass(20, kNothing).action, SafetyAction::none);
  EXPECT_TRUE(safety.findings(good(now)).empty());
}

struct Silence {
  Time Heard::*what;
  Cause cause;
  double limit_s;
};

// Hazard: Stages and links | no scan, registered scan, verdict or state for 0.5 s, no occupancy for
//   2 s, no plan for 4 s, no map for 5 s | stops and holds; goes on 3 s after it came back,
//   lands after 10 s | –
TEST_F(SafetyTest, HoldsForWhateverFallsSilentAndThenLandsWithItsCause) {
  const Silence silences[] = {{&Heard::vehicle, Cause::vehicle_silent, config.vehicle_s},
                              {&Heard::lidar, Cause::lidar_silent, config.lidar_s},
                              {&Heard::odometry, Cause::odometry_stale, config.odometry_s},
                              {&Heard::verdict, Cause::checker_silent, config.verdict_s},
                              {&Heard::occupancy, Cause::occupancy_stale, config.occupancy_s},
                              {&Heard::mapping, Cause::mapping_stale, config.mapping_s},
                              {&Heard::planning, Cause::planning_stale, config.planning_s},
                              {&Heard::guidance, Cause::guidance_silent, 0.5}};
  for (const Silence& silence : silences) {
    SCOPED_TRACE(to_string(silence.cause));
    Safety ladder(config, motion::Geofence(motion::GeofenceConfig{}));
    SafetyInput input = good(now);
    input.heard.*silence.what = now - from_seconds(silence.limit_s);
    EXPECT_EQ(ladder.update(input).action, SafetyAction::none);
    input.heard.*silence.what -= kStep;
    const SafetyDecision held = ladder.update(input);
    EXPECT_EQ(held.action, SafetyAction::hold);
    EXPECT_EQ(held.cause, silence.cause);
    if (silence.cause == Cause::odometry_stale) continue;  // that one ends in silence
    SafetyInput later = good(now + from_seconds(config.land_after_s));
    later.heard.*silence.what = input.heard.*silence.what;
    EXPECT_EQ(ladder.update(later).action, SafetyAction::land);
    EXPECT_EQ(ladder.update(later).cause, silence.cause);
  }
}

// A flight controller without poses comes down by itself after half a second: stops before it.
TEST_F(SafetyTest, HoldsForAPoseThatStandsStillBeforeTheFlightControllerComesDown) {
  const auto aged = [](double age_s) {
    return [age_s](SafetyInput& input) { input.odometry.stamp = input.now - from_seconds(age_s); };
  };
  EXPECT_EQ(pass(1, aged(0.35)).action, SafetyAction::none);
  const SafetyDecision held = pass(0.1, aged(0.45));
  EXPECT_EQ(held.action, SafetyAction::hold);
  EXPECT_EQ(held.cause, Cause::odometry_stale);
}

// Hazard: Odometry | no registered scan for 1 s, the inertial unit does not bridge it | no
//   setpoints: the flight controller descends and lands, even when scans register again
//   (`odometry_lost`) | –
TEST_F(SafetyTest, SilencesTheSetpointsWhenOdometryIsLost) {
  const Time last = now;
  const auto frozen = [last](SafetyInput& input) { input.heard.odometry = last; };
  EXPECT_EQ(pass(config.odometry_lost_s - 0.1, frozen).action, SafetyAction::hold);
  EXPECT_EQ(pass(0.2, frozen).action, SafetyAction::silence);
  const auto lost = [](SafetyInput& in) { in.odometry.status = VehicleOdometryStatus::lost; };
  EXPECT_EQ(pass(kStep * 1e-9, lost).cause, Cause::odometry_lost);
}

TEST_F(SafetyTest, HoldsWhileTheInertialUnitKnowsThePlaceAndEndsInSilenceWhenItDoesNot) {
  const Time last = now;
  const auto coasts = [last](SafetyInput& input) {
    input.heard.odometry = last;
    input.odometry.status = VehicleOdometryStatus::predicted;
    input.odometry.covariance = Matrix6d::Identity() * 0.01;
  };
  EXPECT_EQ(pass(4, coasts).action, SafetyAction::hold);
  const auto without_covariance = [&](SafetyInput& input) {
    coasts(input);
    input.odometry.covariance(3, 3) = NAN;
  };
  EXPECT_EQ(pass(kStep * 1e-9, without_covariance).action, SafetyAction::silence);
  const auto lost = [&](SafetyInput& input) {
    coasts(input);
    input.odometry.status = VehicleOdometryStatus::lost;
  };
  EXPECT_EQ(pass(kStep * 1e-9, lost).action, SafetyAction::silence);
}

TEST_F(SafetyTest, EndsAHoldSomeSecondsAfterItsCauseIsGone) {
  const auto no_verdict = [](SafetyInput& input) { input.heard.verdict -= kNanosecondsPerSecond; };
  EXPECT_EQ(pass(1, no_verdict).action, SafetyAction::hold);
  EXPECT_EQ(pass(config.recover_s - 0.1, kNothing).action, SafetyAction::hold);
  EXPECT_EQ(pass(0.3, kNothing).action, SafetyAction::none);
}

TEST_F(SafetyTest, ACauseThatComesAndGoesStillLands) {
  SafetyDecision decision;
  for (int i = 0; i < 20 && decision.action < SafetyAction::land; ++i) {
    decision = pass(1, [](SafetyInput& input) { input.heard.verdict = 0; });
    if (decision.action < SafetyAction::land) decision = pass(1, kNothing);
  }
  EXPECT_EQ(decision.action, SafetyAction::land);
}

TEST_F(SafetyTest, TheMoreSevereWins) {
  const auto both = [](SafetyInput& input) {
    input.heard.verdict = 0;
    input.vehicle.battery_share = 0.05;
  };
  EXPECT_EQ(pass(1, both).action, SafetyAction::land);
  EXPECT_EQ(pass(1, both).cause, Cause::battery_empty);
}

// Hazard: Vehicle | battery below 30 %, 15 % | returns, lands (`battery_low`, `battery_empty`) | –
TEST_F(SafetyTest, ReturnsWithALowBattery) {
  const auto low = [](SafetyInput& input) { input.vehicle.battery_share = 0.25; };
  EXPECT_EQ(pass(1, low).action, SafetyAction::return_home);
  EXPECT_EQ(pass(1, low).cause, Cause::battery_low);
}

Cause on_the_ground(const Safety& safety, SafetyInput input) {
  input.flying = false;
  const std::vector<Finding> found = safety.findings(input);
  return found.empty() ? Cause::none : found.front().cause;
}

// Hazard: Vehicle | the charge of the battery is not known on the ground | it does not take off
//   (`battery_unknown`) | –
TEST_F(SafetyTest, AChargeThatIsNotKnownKeepsItOnTheGround) {
  SafetyInput input = good(now);
  EXPECT_EQ(on_the_ground(safety, input), Cause::none);
  for (const double share : {static_cast<double>(NAN), -0.1, 1.1}) {
    input.vehicle.battery_share = share;
    EXPECT_EQ(on_the_ground(safety, input), Cause::battery_unknown) << share;
  }
}

const auto kUnknown = [](SafetyInput& input) { input.vehicle.battery_share = NAN; };

// Hazard: Vehicle | the charge of the battery is not known for 5 s in flight | returns, lands where
//   it is when what it was last is used up (`battery_unknown`, `battery_empty`) | –
TEST_F(SafetyTest, AChargeThatIsNoLongerSaidReturnsAndRunsOut) {
  (void)pass(1, kNothing);
  EXPECT_EQ(pass(config.battery_unknown_s - 0.1, kUnknown).action, SafetyAction::none);
  const SafetyDecision decision = pass(0.3, kUnknown);
  EXPECT_EQ(decision.action, SafetyAction::return_home);
  EXPECT_EQ(decision.cause, Cause::battery_unknown);
  const double lasts_s = (0.8 - config.battery_land_share) * config.battery_flight_s;
  EXPECT_EQ(pass(lasts_s - 10, kUnknown).action, SafetyAction::return_home);
  EXPECT_EQ(pass(40, kUnknown).cause, Cause::battery_empty);
}

TEST_F(SafetyTest, AChargeThatIsSaidAgainIsFlownOnWith) {
  (void)pass(1, kNothing);
  (void)pass(config.battery_unknown_s + 1, kUnknown);
  EXPECT_EQ(pass(0.1, kNothing).action, SafetyAction::none);
}

/// So far from home, with so much charge, at the drain that is believed before one is measured.
SafetyDecision far_away(const SafetyConfig& config, double way_m, double share) {
  Safety ladder(config, motion::Geofence(motion::GeofenceConfig{
                            .polygon_m = {-1e4, -1e4, 1e4, -1e4, 1e4, 1e4, -1e4, 1e4}}));
  SafetyInput input = good(100 * kNanosecondsPerSecond);
  input.place = {way_m, 0, 3};
  input.vehicle.battery_share = share;
  return ladder.update(input);
}

// Hazard: Vehicle | the battery is down to what the way home takes, and the reserve | returns;
//   lands where it is when the way home takes more (`battery_low`, `battery_empty`) | –
TEST_F(SafetyTest, ReturnsWhileTheBatteryStillTakesItHomeWithAReserve) {
  const double way_m = 400, way = (way_m / config.way_home_mps + 6) / config.battery_flight_s;
  const double reserve = config.battery_land_share;
  EXPECT_EQ(far_away(config, way_m, way + reserve + 0.01).action, SafetyAction::none);
  const SafetyDecision low = far_away(config, way_m, way + reserve - 0.01);
  EXPECT_EQ(low.action, SafetyAction::return_home);
  EXPECT_EQ(low.text, "battery at 59 %, the way home takes 45 % and the reserve 15 %");
  const SafetyDecision empty = far_away(config, way_m, way - 0.01);
  EXPECT_EQ(empty.action, SafetyAction::land);
  EXPECT_EQ(empty.cause, Cause::battery_empty);
  EXPECT_EQ(far_away(config, NAN, 0.5).action, SafetyAction::hold);  // nowhere
}

TEST_F(SafetyTest, LandsAfterAContactThatWasFelt) {
  const auto hit = [](SafetyInput& input) { input.contact = {input.now - kStep, 20}; };
  EXPECT_EQ(pass(1, hit).cause, Cause::collision);
  EXPECT_EQ(pass(1, hit).action, SafetyAction::land);
  const auto by_controller = [](SafetyInput& input) { input.vehicle.faults = kCollision; };
  EXPECT_EQ(pass(1, by_controller).cause, Cause::collision);
}

TEST_F(SafetyTest, TheGroundThatItComesDownToIsNoContact) {
  for (const VehicleMode mode : {VehicleMode::land, VehicleMode::descend}) {
    SafetyInput input = good(now);
    input.contact = {now, 20};
    input.vehicle.mode = mode;
    for (const Finding& finding : safety.findings(input))
      EXPECT_NE(finding.cause, Cause::collision);
  }
}

TEST_F(SafetyTest, AContactOfThePastIsOver) {
  EXPECT_EQ(pass(1,
                 [](SafetyInput& input) {
                   input.contact = {input.now - 2 * kNanosecondsPerSecond, 20};
                 })
                .action,
            SafetyAction::none);
}

// Hazard: Odometry | what the flight controller gets contradicts its inertial unit and barometer |
//   it descends; it is not believed again the next moment (`vehicle_descends`) | –
TEST_F(SafetyTest, LandsWhenTheFlightControllerComesDownByItself) {
  const auto descends = [](SafetyInput& input) {
    input.vehicle.mode = VehicleMode::descend;
    input.vehicle.faults = kOdometryRejected;
  };
  const SafetyDecision decision = pass(1, descends);
  EXPECT_EQ(decision.action, SafetyAction::land);
  EXPECT_EQ(decision.text, "the flight controller rejects the odometry");
}

// Hazard: Vehicle | outside the geofence | holds, lands (`outside_geofence`) | –
TEST_F(SafetyTest, HoldsOutsideTheGeofence) {
  const auto out = [](SafetyInput& input) { input.place = {0, 101, 3}; };
  EXPECT_EQ(pass(1, out).cause, Cause::outside_geofence);
  EXPECT_EQ(pass(1, out).action, SafetyAction::hold);
}

// Hazard: Vehicle | it does not follow its setpoints | holds, lands (`off_course`) | –
TEST_F(SafetyTest, HoldsWhenTheVehicleDoesNotFollow) {
  const auto off = [](SafetyInput& input) { input.setpoint->position.x() += 2; };
  EXPECT_EQ(pass(1, off).cause, Cause::off_course);
}

TEST_F(SafetyTest, ASetpointThatIsNotANumberIsNotFollowed) {
  const auto broken = [](SafetyInput& input) { input.setpoint->position.setConstant(NAN); };
  EXPECT_EQ(pass(1, broken).cause, Cause::off_course);
}

TEST_F(SafetyTest, APlaceThatIsNotANumberIsOutsideTheGeofence) {
  const auto broken = [](SafetyInput& input) { input.place.setConstant(NAN); };
  EXPECT_EQ(pass(1, broken).action, SafetyAction::hold);
}

TEST_F(SafetyTest, FindsEverythingThatIsMissingOnTheGround) {
  SafetyInput input;
  input.now = now;
  input.place = Eigen::Vector3d::Zero();
  const std::vector<Finding> found = safety.findings(input);
  std::vector<Cause> causes;
  for (const Finding& finding : found) causes.push_back(finding.cause);
  for (const Cause cause : {Cause::vehicle_silent, Cause::lidar_silent, Cause::odometry_stale,
                            Cause::checker_silent, Cause::occupancy_stale, Cause::mapping_stale}) {
    EXPECT_NE(std::find(causes.begin(), causes.end(), cause), causes.end()) << to_string(cause);
  }
  EXPECT_EQ(found.front().text, "no state of the vehicle yet");
}

TEST_F(SafetyTest, ForgetsItsHoldOnTheGround) {
  const auto no_verdict = [](SafetyInput& input) { input.heard.verdict = 0; };
  EXPECT_EQ(pass(1, no_verdict).action, SafetyAction::hold);
  (void)pass(0.1, [](SafetyInput& input) { input.flying = false; });
  EXPECT_EQ(pass(0.1, kNothing).action, SafetyAction::none);
}

}  // namespace
}  // namespace saker::autonomy
