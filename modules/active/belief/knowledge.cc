#include "saker/active/belief/knowledge.h"

#include <algorithm>
#include <cmath>

namespace saker::active {
namespace {

bool is_cylinder(objects::ClassId class_id, const ViewModel& model) {
  return model.common(class_id).rows() == 2;
}

Covariance counted_common(const Target& target, const ViewModel& model, const PamsConfig& config) {
  const Covariance common = model.common(target.class_id);
  return config.common_counts ? common : Covariance(0 * common);
}

/// What one view contributes, if x and y have drifted since the first one.
Information information(const Measured& measured, double flown_m, const PamsConfig& config) {
  const double drift = config.drift_counts ? config.drift_m * config.drift_m * flown_m : 0;
  return information_of(measured, drift);
}

}  // namespace

uncertainty::View view_from(const Eigen::Vector3d& eye, const Target& target,
                            const ViewModel& model) {
  if (!is_cylinder(target.class_id, model)) return uncertainty::view_of(eye, target.extent);
  objects::Cylinder cylinder;
  cylinder.height = target.extent.size.z();
  cylinder.radius = 0.5 * target.extent.size.x();
  cylinder.root = target.place() - 0.5 * cylinder.height * Eigen::Vector3d::UnitZ();
  return uncertainty::view_of(eye, cylinder);
}

PredictedView predicted(const Eigen::Vector3d& eye, const Target& target, const ViewModel& model,
                        const PamsConfig& config) {
  const uncertainty::Prediction fitted =
      model.predict(target.class_id, view_from(eye, target, model));
  const bool by_face = config.faces.hidden_end_m > 0 || config.faces.hidden_side_m > 0;
  if (!by_face || is_cylinder(target.class_id, model)) {
    return {fitted.cell, {fitted.covariance / fitted.whole}};
  }
  const Eigen::Vector3d in_box = target.extent.pose.inverse() * eye;
  return {fitted.cell, by_faces(fitted.covariance, fitted.whole, in_box.head<2>(),
                                target.extent.size.head<2>(), config.faces)};
}

Covariance prior_covariance(const PamsConfig& config, bool cylinder) {
  const double place = config.prior_place_m * config.prior_place_m;
  const double length = config.prior_length_m * config.prior_length_m;
  const double width = config.prior_width_m * config.prior_width_m;
  const Eigen::Vector4d variances(place, place, length, width);
  return Covariance(variances.head(cylinder ? 2 : 4).asDiagonal());
}

Knowledge::Knowledge(const Target& target, const ViewHistory& views, const ViewModel& model,
                     const PamsConfig& config)
    : common_(counted_common(target, model, config)),
      belief_(prior_covariance(config, is_cylinder(target.class_id, model)), common_) {
  struct Cell {
    double seconds = 0;
    Information weighted = Information::Zero();  // Σ seconds · information
  };
  std::map<int, Cell> cells;
  for (const ViewHistory::Dwell& dwell : views.dwells()) {
    const PredictedView view = predicted(dwell.eye, target, model, config);
    Cell& cell = cells[view.cell];
    cell.seconds += dwell.seconds;
    cell.weighted +=
        dwell.seconds * information(view.measured, dwell.flown_m - views.first_m(), config);
  }
  for (const auto& [id, cell] : cells) {
    if (cell.seconds < config.dwell_s) continue;
    cells_.emplace(id, cell.weighted / cell.seconds);
    belief_.add(cells_.at(id));
  }
}

Belief Knowledge::expected(const Covariance& covariance, const Knowledge& then) const {
  Belief belief = belief_.known_to(covariance);
  const double scatter = scatter_of(belief);
  for (const auto& [id, information] : then.cells_) {
    if (!counted(id)) belief.add(information / scatter);
  }
  return belief;
}

/// By which the variances of the map exceed those of the views; 1 below two views, which cannot
/// contradict each other.
double Knowledge::scatter_of(const Belief& map) const {
  if (cells_.size() < 2) return 1;
  const double excess = map.entropy() - belief_.entropy();
  return std::max(1.0, std::exp(2 * excess / static_cast<double>(common_.rows())));
}

Belief map_belief(const Target& target, const ViewHistory& held, const ViewHistory& until,
                  const ViewModel& model, const PamsConfig& config) {
  PamsConfig of_windows = config;
  of_windows.dwell_s = config.window_s;
  const Knowledge then(target, until, model, of_windows);
  if (target.covariance.size() == 0) return then.belief();
  return Knowledge(target, held, model, of_windows).expected(target.covariance, then);
}

}  // namespace saker::active
