#include "saker/autonomy/fitted_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "saker/core/config_folder.h"
#include "saker/core/error.h"
#include "saker/objects/stated_length.h"
#include "saker/objects/view_cell.h"
#include "saker/slam/model_algebra.h"
#include "saker/uncertainty/view.h"

namespace saker::autonomy {
namespace {

using objects::Measurement;

/// The planar part of a covariance replaced; nothing is known of how it goes with the rest.
Eigen::MatrixXd with_planar(const Eigen::MatrixXd& covariance, const std::vector<int>& rows,
                            const Eigen::MatrixXd& fitted) {
  Eigen::MatrixXd result = covariance;
  for (const int row : rows) {
    result.row(row).setZero();
    result.col(row).setZero();
  }
  result(rows, rows) = fitted;
  return result;
}

/// Named so that x points to the likelier front: the side that it is seen from is told by that.
void name_by_front(Measurement& m) {
  if (!std::holds_alternative<objects::Cuboid>(m.model) || !(m.front_log_odds < 0)) return;
  const slam::Gaussian turned = slam::turned(slam::Gaussian{m.model, m.covariance}, 2);
  m.model = turned.model;
  m.covariance = turned.covariance;
  m.front_log_odds = -m.front_log_odds;
}

/// Columns: along the line of sight away from the lidar, to its left, up; from the levelled frame
/// in which `place` is given.
Eigen::Matrix3d sight_frame(const Eigen::Vector3d& place) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d away = Eigen::Vector3d(place.x(), place.y(), 0).normalized();
  Eigen::Matrix3d frame;
  frame << away, up.cross(away), up;
  return frame;
}

/// The covariance with neither end better known than a window may know it that states such
/// variances of the low and the high end.
void raise_ends(Eigen::MatrixXd& covariance, const Eigen::Vector2d& stated,
                const slam::MeasurementNoiseConfig& noise) {
  const Eigen::Vector2d least = stated.cwiseAbs2() / std::pow(noise.fitted_end_sd_m, 2);
  slam::raise_end_variances(covariance, 0, least);
}

/// Of [x, y, length, width]: where the side is that a window did not show. The near one stays as
/// well known as the fit says: the width grows away from the lidar.
Eigen::Matrix4d hidden_side(const objects::Cuboid& cuboid, double width_sd,
                            const slam::MeasurementNoiseConfig& noise) {
  const double variance = width_sd > noise.fitted_width_sd_m ? width_sd * width_sd : 0;
  const Eigen::Vector3d eye = cuboid.pose.inverse() * Eigen::Vector3d::Zero();
  const Eigen::Vector4d grows(0, eye.y() < 0 ? 0.5 : -0.5, 0, 1);
  return variance * grows * grows.transpose();
}

void correct(Measurement& m, objects::Cuboid cuboid, const uncertainty::Prediction& fitted,
             const Eigen::Matrix3d&, const slam::MeasurementNoiseConfig& noise) {
  const Eigen::VectorXd& bias = fitted.bias;
  m.length_sd = objects::length_sd(m);
  cuboid.pose.translation() -= cuboid.pose.linear() * Eigen::Vector3d(bias[0], bias[1], 0);
  cuboid.size.head<2>() -= bias.tail<2>();
  const std::vector<int> rows = objects::planar_rows(m.model);
  const double width_sd = std::sqrt(m.covariance(rows[3], rows[3]));
  const Eigen::Vector2d stated_ends = slam::end_variances(m.covariance, 0);
  m.covariance =
      with_planar(m.covariance, rows, fitted.covariance + hidden_side(cuboid, width_sd, noise));
  raise_ends(m.covariance, stated_ends, noise);
  m.model = cuboid;
}

void correct(Measurement& m, objects::Cylinder cylinder, const uncertainty::Prediction& fitted,
             const Eigen::Matrix3d& R_odom_lidar, const slam::MeasurementNoiseConfig&) {
  const Eigen::Matrix3d B = R_odom_lidar.transpose() * sight_frame(R_odom_lidar * cylinder.root);
  cylinder.root -= B * Eigen::Vector3d(fitted.bias[0], fitted.bias[1], 0);
  Matrix6d J = Matrix6d::Identity();  // from the sight frame to the lidar's
  J.topLeftCorner<3, 3>() = B;
  const Eigen::MatrixXd in_sight = J.transpose() * m.covariance * J;
  m.covariance = J * with_planar(in_sight, {0, 1}, fitted.covariance) * J.transpose();
  m.model = cylinder;
}

/// Flown, seen from end to end, and something is left of the object without the bias.
bool fits(const uncertainty::Prediction& fitted, const Measurement& m, double whole_length_sd_m) {
  if (fitted.extrapolated) return false;
  const auto* cuboid = std::get_if<objects::Cuboid>(&m.model);
  if (cuboid == nullptr) return true;
  return objects::length_sd(m) <= whole_length_sd_m &&
         (cuboid->size.head<2>() - fitted.bias.tail<2>()).minCoeff() > 0;
}

void apply(const uncertainty::Model& model, const slam::MeasurementNoiseConfig& noise,
           const Eigen::Matrix3d& R_odom_lidar, Measurement& m) {
  if (!model.knows(m.class_id)) return;
  Measurement named = m;
  name_by_front(named);
  SE3 T_levelled_lidar = SE3::Identity();
  T_levelled_lidar.linear() = R_odom_lidar;
  uncertainty::View view = uncertainty::view_of(
      Eigen::Vector3d::Zero(), objects::transformed(T_levelled_lidar, named.model));
  view.reflectivity = m.reflectivity;
  if (!(view.range > 0) || !std::isfinite(view.angle)) return;
  const uncertainty::Prediction fitted = model.predict(m.class_id, view);
  if (fitted.bias.size() != static_cast<Eigen::Index>(objects::planar_rows(m.model).size())) return;
  if (!fits(fitted, named, model.of(m.class_id).geometric.parts().whole_length_sd_m)) {
    m.view_cell = objects::uncorrected_cell(fitted.cell);
    return;
  }
  std::visit([&](const auto& shape) { correct(named, shape, fitted, R_odom_lidar, noise); },
             objects::Model(named.model));
  named.view_cell = objects::corrected_cell(fitted.cell);
  m = std::move(named);
}

}  // namespace

std::shared_ptr<const uncertainty::Model> load_uncertainty(const UncertaintyConfig& config,
                                                           const objects::ClassTable& table) {
  const auto file = core::find_in_configs(config.model, "uncertainty.model");
  return std::make_shared<const uncertainty::Model>(uncertainty::Model::load(file, table));
}

std::string sensor_note(const uncertainty::Provenance& fitted, const std::string& sensor) {
  const std::string& known = fitted.sensor;  // of several fits: all of them
  if (!sensor.empty() && known.find(sensor) != std::string::npos) return {};
  const std::string model = sensor.substr(0, sensor.find(' '));
  std::string who = "an unknown sensor";
  if (!sensor.empty()) who = "this " + sensor;
  const bool same_model = !model.empty() && known.find(model + " ") != std::string::npos;
  return fmt::format(
      "uncertainty.model is fitted to {}, not to {}{}: used as it is, "
      "slam.measurement_noise=fixed does without",
      known.empty() ? "a sensor it does not name" : known, who,
      same_model ? ", another mode of the same" : "");
}

FittedNoise::FittedNoise(const slam::SlamConfig& config,
                         std::shared_ptr<const uncertainty::Model> model)
    : noise_(config.noise) {
  if (config.measurement_noise == slam::NoiseSource::fixed) return;
  if (model == nullptr) throw Error("slam.measurement_noise: fitted, expected a fitted model");
  model_ = std::move(model);
}

objects::Detections FittedNoise::applied(objects::Detections detections,
                                         const Eigen::Matrix3d& R_odom_lidar) const {
  if (model_ == nullptr) return detections;
  for (Measurement& m : detections.measurements) apply(*model_, noise_, R_odom_lidar, m);
  return detections;
}

Eigen::MatrixXd FittedNoise::common_of(const objects::MapObject& object) const {
  Eigen::MatrixXd common = slam::common_variances(object.model, noise_).asDiagonal();
  const bool is_fitted = model_ != nullptr && model_->knows(object.class_id);
  if (!is_fitted || !slam::is_cuboid(object.model)) return common;
  const std::vector<int> rows = objects::planar_rows(object.model);
  common(rows, rows) = model_->common_covariance(object.class_id);
  return common;
}

void FittedNoise::add_common(objects::ObjectMap& map) const {
  for (objects::MapObject& object : map.objects) {
    if (object.covariance.size() > 0) object.covariance += common_of(object);
  }
}

}  // namespace saker::autonomy
