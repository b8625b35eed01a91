#include "saker/odometry/turn_finder.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace saker::odometry {
namespace {

constexpr int kBeginnings = 72;         // 5° apart
constexpr int kMostPoints = 400;        // of a voxel: as many as the map takes
constexpr double kGate_m = 0.3;         // points farther from their planes are of something else
constexpr double kLeastMoved_m = 0.05;  // in a period, at 10 m: less says nothing
constexpr double kUsualRange_m = 10;
constexpr std::size_t kMostScans = 1000;  // counted: as many as a setting asks for

TurnFinder::Terms terms_of(double azimuth) {
  TurnFinder::Terms terms;
  for (int k = 1; k <= TurnFinder::kHarmonics; ++k) {
    terms[2 * k - 2] = std::cos(k * azimuth);
    terms[2 * k - 1] = std::sin(k * azimuth);
  }
  return terms;
}

/// Of the part of the sweep after its middle, passed(φ) − ½: a sawtooth's Fourier series.
TurnFinder::Terms sawtooth(const Turn& turn) {
  const double sign = turn.clockwise ? -1 : 1;
  TurnFinder::Terms terms;
  for (int k = 1; k <= TurnFinder::kHarmonics; ++k) {  // −sin(k sign (φ − begin)) / (πk)
    terms[2 * k - 2] = sign * std::sin(k * turn.begin_rad) / (M_PI * k);
    terms[2 * k - 1] = -sign * std::cos(k * turn.begin_rad) / (M_PI * k);
  }
  return terms;
}

Eigen::Vector3d velocity_at(const Eigen::Vector3d& point, const Vector6d& twist) {
  return twist.tail<3>() + twist.head<3>().cross(point);
}

}  // namespace

TurnFinder::TurnFinder(const TurnFinderConfig& config, double voxel_m, int most_voxels)
    : config_(config), voxel_m_(voxel_m), index_(static_cast<std::size_t>(most_voxels)) {}

void TurnFinder::match(const Eigen::Vector3d& point, float azimuth, const SE3& T_odom_lidar,
                       const Vector6d& twist, VoxelMap& map) {
  const Eigen::Vector3d placed = T_odom_lidar * point;
  const auto plane = map.nearest_plane(placed, false);
  if (!plane) return;
  const std::uint32_t at = index_.find(voxel_key(voxel_cell(placed, 1 / voxel_m_)));
  const double distance = plane->normal.dot(placed - plane->point);
  if (at == VoxelIndex::kNone || std::abs(distance) > kGate_m) return;
  const Voxel& voxel = voxels_[at];
  const Eigen::Vector3d normal = T_odom_lidar.linear().transpose() * plane->normal;
  const Terms of_plane =
      voxel.sum.cast<double>().transpose() * plane->normal / static_cast<double>(voxel.count);
  matches_.push_back({point, normal,
                      normal.dot(velocity_at(point, twist)) * terms_of(azimuth) - of_plane,
                      distance, plane->variance});
}

void TurnFinder::compare(std::span<const Eigen::Vector3d> points, std::span<const float> azimuths,
                         const SE3& T_odom_lidar, const Vector6d& twist, double period_s,
                         VoxelMap& map) {
  matches_.clear();
  if (twist.tail<3>().norm() + kUsualRange_m * twist.head<3>().norm() < kLeastMoved_m) return;
  for (std::size_t i = 0; i < points.size(); ++i)
    match(points[i], azimuths[i], T_odom_lidar, twist, map);
  Matrix6d of_pose = 1e-6 * Matrix6d::Identity();
  Eigen::Matrix<double, 6, kTerms> shared = Eigen::Matrix<double, 6, kTerms>::Zero();
  Eigen::Matrix<double, kTerms, kTerms> of_terms = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Vector6d pull_pose = Vector6d::Zero();
  Terms pull_terms = Terms::Zero();
  double chi2 = 0, weights = 0;
  for (const Match& m : matches_) {
    const double square = m.distance * m.distance, kernel2 = config_.kernel_m * config_.kernel_m;
    const double robust = std::pow(kernel2 / (kernel2 + square), 2);  // Geman-McClure
    const double w = robust / (config_.noise_m * config_.noise_m + m.variance);
    Vector6d J;
    J << m.point.cross(m.normal), m.normal;
    of_pose += w * J * J.transpose();
    shared += w * J * m.sensitivity.transpose();
    of_terms += w * m.sensitivity * m.sensitivity.transpose();
    pull_pose -= w * m.distance * J;
    pull_terms -= w * m.distance * m.sensitivity;
    chi2 += w * square;
    weights += robust;
  }
  const double inflation = config_.correlation * std::max(1.0, chi2 / std::max(1.0, weights));
  const Eigen::LDLT<Matrix6d> solver(of_pose);
  information_ += (of_terms - shared.transpose() * solver.solve(shared)) / inflation;
  weighted_ += (pull_terms - shared.transpose() * solver.solve(pull_pose)) / inflation;
  if (periods_s_.size() < kMostScans) periods_s_.push_back(period_s);
}

void TurnFinder::insert(std::span<const Eigen::Vector3d> points, std::span<const float> azimuths,
                        const SE3& T_odom_lidar, const Vector6d& twist) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const VoxelKey key = voxel_key(voxel_cell(T_odom_lidar * points[i], 1 / voxel_m_));
    const std::uint32_t at = index_.find_or_insert(key, static_cast<std::uint32_t>(voxels_.size()));
    if (at == VoxelIndex::kNone) continue;
    if (at == voxels_.size()) voxels_.emplace_back();
    Voxel& voxel = voxels_[at];
    if (voxel.count >= kMostPoints) continue;
    const Eigen::Vector3d moved = T_odom_lidar.linear() * velocity_at(points[i], twist);
    voxel.sum += (moved * terms_of(azimuths[i]).transpose()).cast<float>();
    ++voxel.count;
  }
}

void TurnFinder::clear_map() {
  index_.clear();
  voxels_.clear();
}

double TurnFinder::period_of(double seconds) const {
  return seconds <= config_.longest_period_s ? seconds : config_.usual_period_s;
}

double TurnFinder::usual_period_s() const {
  std::vector<double> sorted = periods_s_;
  const auto middle = sorted.begin() + std::ssize(sorted) / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  return sorted.empty() ? config_.usual_period_s : *middle;
}

TurnFinder::Answer TurnFinder::answer(const Turn& turn) const {
  const Terms shape = sawtooth(turn);
  const double information = shape.dot(information_ * shape), pull = shape.dot(weighted_);
  if (!(information > 0)) return {.turn = turn, .sd = INFINITY};
  return {.turn = turn,
          .share = pull / information,
          .sd = 1 / std::sqrt(information),
          .gain = std::copysign(pull * pull / information, pull)};
}

TurnFinder::Answer TurnFinder::best() const {
  Answer best = answer({});
  for (const bool clockwise : {true, false}) {
    for (int k = 0; k < kBeginnings; ++k) {
      const Answer other = answer({clockwise, M_PI * (2.0 * k / kBeginnings - 1)});
      if (other.gain > best.gain) best = other;
    }
  }
  return best;
}

std::optional<Turn> TurnFinder::found() const {
  const Answer answer = best();
  if (scans() < config_.least_scans || answer.gain < config_.least_gain ||
      answer.share < config_.least_share)
    return std::nullopt;
  return answer.turn;
}

bool TurnFinder::contradicts(const Turn& turn) const {
  const Answer opposite = answer({!turn.clockwise, turn.begin_rad});
  return scans() >= config_.least_scans && opposite.gain >= config_.least_gain &&
         opposite.share >= config_.least_contradiction;
}

bool TurnFinder::compensated() const {
  const Answer answer = best();
  return answer.sd < config_.compensated_sd && answer.share < config_.least_share;
}

}  // namespace saker::odometry
