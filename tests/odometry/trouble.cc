#include "trouble.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "made_world.h"
#include "saker/core/rng.h"

namespace saker::odometry::testing {
namespace {

constexpr Time kPeriod = 100'000'000;
constexpr int kScans = 110;
constexpr double kFarOff_m = 0.3;
constexpr int kPerSecond = 10;
constexpr std::size_t kBeginning = 20;  // scans, in which speed and map are not known yet

/// House fronts, parked boxes and poles, none where it stood in another seed's.
MadeWorld street_of(core::Rng& rng) {
  MadeWorld world;
  for (double x = -40; x < 160;) {
    const double length = rng.uniform(6, 14);
    const double left = rng.uniform(8, 12), right = -rng.uniform(8, 12);
    world.boxes.push_back({{x, left, 0}, {x + length, left + 5, rng.uniform(5, 10)}});
    world.boxes.push_back({{x - 2, right - 5, 0}, {x + length - 2, right, rng.uniform(5, 10)}});
    if (rng.uniform(0, 1) < 0.7)
      world.boxes.push_back({{x + 1, 4, 0}, {x + 5.3, 5.8, rng.uniform(1.4, 2)}});
    const double pole = x + rng.uniform(0, length);
    world.boxes.push_back({{pole, -6.2, 0}, {pole + 0.25, -5.95, 6}});
    x += length;
  }
  return world;
}

constexpr double kShortSight_m = 25;
constexpr double kSmooth_m = 20;

/// The street with smooth walls instead, where a sensor of short sight sees nothing else from x to
/// kSmooth_m farther on.
MadeWorld with_smooth_stretch(const MadeWorld& street, double x) {
  const double from = x - kShortSight_m, to = x + kSmooth_m + kShortSight_m;
  MadeWorld world;
  for (const Box& box : street.boxes)
    if (box.high.x() < from || box.low.x() > to) world.boxes.push_back(box);
  world.boxes.push_back({{from, 6, 0}, {to, 7, 12}});
  world.boxes.push_back({{from, -7, 0}, {to, -6, 12}});
  return world;
}

struct Motions {
  double speed, sway, turn, phase;
  bool from_rest;  // as a multirotor; a car's recording begins on the way

  [[nodiscard]] SE3 at(Time time) const {
    // It stands for a second and is at full speed two seconds later.
    const double on = std::clamp((to_seconds(time) - 1) / 2, 0.0, 1.0);
    const double way = on < 1 ? 2 * (on * on * on - 0.5 * on * on * on * on) : to_seconds(time) - 2;
    const double t = from_rest ? way : to_seconds(time);
    const double p = 0.8 * t + phase;
    SE3 T = SE3::Identity();
    T.translation() << speed * t, sway * std::sin(p), 2.5 + 0.3 * std::sin(0.5 * t + phase);
    T.linear() = (Eigen::AngleAxisd(turn * std::sin(p), Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(0.1 * std::sin(1.7 * t), Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(0.1 * std::sin(1.3 * t), Eigen::Vector3d::UnitX()))
                     .toRotationMatrix();
    return T;
  }
};

void hide(lidar::Scan& scan, double share) {
  const auto columns = static_cast<std::size_t>(scan.columns);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (static_cast<double>(i % columns) < share * static_cast<double>(columns))
      scan.points[i].setConstant(NAN);
  }
}

struct Script {
  Trial trial;
  MadeWorld world;
  Motions motion;
  Eigen::Vector3d gyro_bias;
  int begin = 0, end = 0;  // of trouble, scans
  Time step = 0;           // of the stamps, from `begin` on

  [[nodiscard]] bool in_trouble(int k) const { return k >= begin && k < end; }
};

Script script_of(const Trial& trial) {
  core::Rng rng(trial.seed * 977 + 13);
  Script script;
  script.trial = trial;
  script.world = street_of(rng);
  script.motion = {rng.uniform(1, 6), rng.uniform(0, 1.5), rng.uniform(0, 1.2),
                   rng.uniform(0, 2 * M_PI), trial.with_imu};
  script.gyro_bias = {rng.normal(0, 0.01), rng.normal(0, 0.01), rng.normal(0, 0.01)};
  script.begin = 40 + static_cast<int>(rng.uniform(0, 10));
  double seconds = 0;
  switch (trial.trouble) {
    case Trouble::none:
      break;
    case Trouble::gap:
      seconds = rng.uniform(0.2, 5);
      break;
    case Trouble::covered:
      seconds = rng.uniform(0.2, 2.5);
      break;
    case Trouble::half:
      seconds = 2;
      break;
    case Trouble::kidnapped:
      seconds = 0.1;
      break;
    case Trouble::late:
      script.step = from_seconds(std::exp(rng.uniform(std::log(0.3), std::log(20.0))));
      seconds = 0.1;
      break;
    case Trouble::featureless:
      script.motion.speed = rng.uniform(4, 6);
      script.begin = 60;
      seconds = kSmooth_m / script.motion.speed;
      script.world = with_smooth_stretch(
          script.world, script.motion.at(script.begin * kPeriod).translation().x());
      break;
  }
  script.end =
      std::min(kScans - 25, script.begin + static_cast<int>(std::ceil(seconds * kPerSecond)));
  return script;
}

/// What came of one scan.
struct Step {
  int scan = 0;
  bool good = false;
  SE3 T_true, T_odom_lidar;
  Matrix6d covariance = Matrix6d::Zero();
};

std::vector<Step> steps_of(const Script& script, const OdometryConfig& config) {
  MadeSensor sensor;
  sensor.rows = 32;
  sensor.columns = 512;
  sensor.range_noise_m = 0.02;
  if (script.trial.trouble == Trouble::featureless) sensor.max_range_m = kShortSight_m;
  const Motion motion = [&](Time t) { return script.motion.at(t); };
  core::Rng elsewhere(script.trial.seed + 5000);
  const MadeWorld other = street_of(elsewhere);
  Odometry odometry(config);
  std::vector<Step> steps;
  Time heard = 0;
  for (int k = 1; k <= kScans; ++k) {
    const bool trouble = script.in_trouble(k);
    if (script.trial.trouble == Trouble::gap && trouble) continue;
    const Time stamp = k * kPeriod;
    const bool kidnapped = script.trial.trouble == Trouble::kidnapped && trouble;
    lidar::Scan made = scan(kidnapped ? other : script.world, sensor, motion, stamp);
    if (script.trial.trouble == Trouble::covered && trouble) hide(made, 1);
    if (script.trial.trouble == Trouble::half && trouble) hide(made, 0.5);
    std::vector<lidar::ImuSample> samples;
    if (script.trial.with_imu) samples = imu(motion, heard, stamp, script.gyro_bias);
    heard = stamp;
    const Time step = k >= script.begin ? script.step : 0;
    made.stamp += step;
    for (lidar::ImuSample& sample : samples) sample.stamp += step;
    const OdometryEstimate estimate = odometry.register_scan(made, samples);
    steps.push_back({k, estimate.status == OdometryStatus::ok, motion(stamp), estimate.T_odom_lidar,
                     estimate.covariance});
  }
  return steps;
}

/// Error of the motion from step a to step b, right tangent at b, and what the stated drift of the
/// steps between adds up to there.
struct Drift {
  Vector6d error = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();

  [[nodiscard]] double deviation2() const {
    const Matrix6d floor = 1e-10 * Matrix6d::Identity();
    return error.dot((covariance + floor).ldlt().solve(error)) / 6;
  }
};

Matrix6d adjoint(const SE3& T) {
  Matrix6d A = Matrix6d::Zero();
  A.topLeftCorner<3, 3>() = A.bottomRightCorner<3, 3>() = T.linear();
  A.bottomLeftCorner<3, 3>() = core::hat(T.translation()) * T.linear();
  return A;
}

Drift drift_between(const std::vector<Step>& steps, std::size_t a, std::size_t b) {
  Drift drift;
  const SE3 is = steps[a].T_odom_lidar.inverse() * steps[b].T_odom_lidar;
  const SE3 should = steps[a].T_true.inverse() * steps[b].T_true;
  drift.error = core::se3_log(should.inverse() * is);
  for (std::size_t i = a + 1; i <= b; ++i) {
    const Matrix6d A = adjoint(steps[b].T_odom_lidar.inverse() * steps[i].T_odom_lidar);
    drift.covariance += A * steps[i].covariance * A.transpose();
  }
  return drift;
}

void judge_poses(const std::vector<Step>& steps, std::size_t before, Outcome& outcome) {
  double off_since = -1;
  for (std::size_t i = before + 1; i < steps.size(); ++i) {
    const Drift drift = drift_between(steps, before, i);
    const double error_m = drift.error.tail<3>().norm();
    const double t = 0.1 * steps[i].scan;
    const bool off = error_m > kFarOff_m;
    if (off && off_since < 0) off_since = t;
    if (!off || !steps[i].good) off_since = -1;
    if (off_since >= 0) outcome.unsaid_s = std::max(outcome.unsaid_s, t - off_since + 0.1);
    outcome.end_m = error_m;
    if (!steps[i].good) continue;
    outcome.worst_good_m = std::max(outcome.worst_good_m, error_m);
    outcome.worst_deviation_sd =
        std::max(outcome.worst_deviation_sd, std::sqrt(drift.deviation2()));
  }
}

}  // namespace

Outcome fly(const Trial& trial, const OdometryConfig& config) {
  const Script script = script_of(trial);
  const std::vector<Step> steps = steps_of(script, config);
  Outcome outcome;
  outcome.scans = static_cast<int>(steps.size());
  std::size_t before = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool clean =
        i >= kBeginning && (trial.trouble == Trouble::none || steps[i].scan < script.begin ||
                            steps[i].scan >= script.end + 3 * kPerSecond);
    if (steps[i].scan < script.begin) before = i;
    outcome.clean += clean;
    outcome.clean_good += clean && steps[i].good;
    if (!steps[i].good && steps[i].scan >= script.end)
      outcome.recovered_s = 0.1 * (steps[i].scan - script.end + 1);
    if (!clean || i % kPerSecond != 0 || steps[i].scan - steps[i - 10].scan != 10) continue;
    if (steps[i].scan >= script.begin && steps[i - 10].scan < script.end + 3 * kPerSecond) continue;
    outcome.nees_sum += drift_between(steps, i - 10, i).deviation2();
    ++outcome.nees_count;
  }
  judge_poses(steps, before, outcome);
  return outcome;
}

const char* to_string(Trouble trouble) {
  constexpr const char* kNames[] = {"none",      "gap",  "covered",    "half",
                                    "kidnapped", "late", "featureless"};
  return kNames[static_cast<int>(trouble)];
}

}  // namespace saker::odometry::testing
