#include "saker/objects/comparison.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/core/statistics.h"
#include "saker/objects/assignment.h"

namespace saker::objects {
namespace {

using Objects = std::vector<const MapObject*>;

struct Pair {
  const MapObject *mapped, *truth;
};

Objects of_class(const ObjectMap& map, ClassId id) {
  Objects objects;
  for (const MapObject& object : map.objects) {
    if (object.class_id == id) objects.push_back(&object);
  }
  return objects;
}

bool counts(const MapObject& truth, const ComparisonOptions& options) {
  return truth.points < 0 || truth.points >= options.least_points;
}

double distance(const MapObject& a, const MapObject& b) {
  return (place(a.model) - place(b.model)).head<2>().norm();
}

Eigen::MatrixXd distances(const Objects& mapped, const Objects& truth) {
  Eigen::MatrixXd cost(static_cast<Eigen::Index>(mapped.size()),
                       static_cast<Eigen::Index>(truth.size()));
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      cost(i, j) =
          distance(*mapped[static_cast<std::size_t>(i)], *truth[static_cast<std::size_t>(j)]);
    }
  }
  return cost;
}

/// Whether a mapped object without a partner is another's second self, and does not stand on
/// something of another class beside it.
bool is_duplicate(const MapObject& mapped, const ObjectMap& truth, double gate_m) {
  const auto nearer = [&](const MapObject& a, const MapObject& b) {
    return distance(mapped, a) < distance(mapped, b);
  };
  const auto nearest = std::min_element(truth.objects.begin(), truth.objects.end(), nearer);
  return nearest != truth.objects.end() && nearest->class_id == mapped.class_id &&
         distance(mapped, *nearest) <= gate_m;
}

/// Pairs that count; fills the numbers of the class.
std::vector<Pair> paired(ClassId id, const ObjectMap& mapped_map, const ObjectMap& truth_map,
                         const ComparisonOptions& options, ClassComparison& result) {
  const Objects mapped = of_class(mapped_map, id), truth = of_class(truth_map, id);
  const Eigen::MatrixXd cost = distances(mapped, truth);
  const double gate_m =
      result.shape == Shape::cuboid ? options.cuboid_gate_m : options.cylinder_gate_m;
  const std::vector<int> truth_of = assign(cost, gate_m);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < mapped.size(); ++i) {
    if (truth_of[i] >= 0) {
      const MapObject* partner = truth[static_cast<std::size_t>(truth_of[i])];
      if (counts(*partner, options)) pairs.push_back({mapped[i], partner});
    } else {
      ++(is_duplicate(*mapped[i], truth_map, gate_m) ? result.duplicates : result.invented);
    }
  }
  result.truth = static_cast<int>(std::count_if(
      truth.begin(), truth.end(), [&](const MapObject* t) { return counts(*t, options); }));
  result.mapped = static_cast<int>(mapped.size());
  result.found = static_cast<int>(pairs.size());
  result.missed = result.truth - result.found;
  return pairs;
}

/// One quantity of every pair; a cuboid's and a cylinder's differ in which there are.
struct Quantity {
  const char* name;
  double (*error)(const Pair&);
};

const Cuboid& cuboid(const MapObject* object) { return std::get<Cuboid>(object->model); }
const Cylinder& cylinder(const MapObject* object) { return std::get<Cylinder>(object->model); }

Eigen::Vector3d place_error(const Pair& p) {
  return place(p.mapped->model) - place(p.truth->model);
}
Eigen::Vector3d size_error(const Pair& p) { return cuboid(p.mapped).size - cuboid(p.truth).size; }

double heading_error(const Pair& p) {
  return core::yaw(cuboid(p.truth).pose.linear().transpose() * cuboid(p.mapped).pose.linear());
}

/// Of the longitudinal axis: a front taken for the back is counted, not averaged.
double axis_error_deg(const Pair& p) {
  return std::remainder(heading_error(p), std::numbers::pi) * 180 / std::numbers::pi;
}

constexpr Quantity kPlace[] = {
    {"x_m", [](const Pair& p) { return place_error(p).x(); }},
    {"y_m", [](const Pair& p) { return place_error(p).y(); }},
    {"z_m", [](const Pair& p) { return place_error(p).z(); }},
    {"distance_m", [](const Pair& p) { return place_error(p).head<2>().norm(); }},
};
constexpr Quantity kCuboid[] = {
    {"length_m", [](const Pair& p) { return size_error(p).x(); }},
    {"width_m", [](const Pair& p) { return size_error(p).y(); }},
    {"height_m", [](const Pair& p) { return size_error(p).z(); }},
    {"heading_deg", axis_error_deg},
};
constexpr Quantity kCylinder[] = {
    {"radius_m",
     [](const Pair& p) { return cylinder(p.mapped).radius - cylinder(p.truth).radius; }},
};

std::vector<double> values(const std::vector<Pair>& pairs, double (*value)(const Pair&)) {
  std::vector<double> all;
  for (const Pair& pair : pairs) all.push_back(value(pair));
  return all;
}

template <std::size_t N>
void add_errors(const std::vector<Pair>& pairs, const Quantity (&quantities)[N],
                ClassComparison& result) {
  for (const Quantity& quantity : quantities) {
    const std::vector<double> errors = values(pairs, quantity.error);
    result.errors.push_back({quantity.name, core::mean(errors), core::standard_deviation(errors),
                             core::mean_absolute(errors)});
  }
}

double constant_error(std::vector<double> sizes) {
  const double mean = core::mean(sizes);
  for (double& size : sizes) size -= mean;
  return core::mean_absolute(sizes);
}

void add_size_figures(const std::vector<Pair>& pairs, ClassComparison& result) {
  const auto true_length = values(pairs, [](const Pair& p) { return cuboid(p.truth).size.x(); });
  const auto true_width = values(pairs, [](const Pair& p) { return cuboid(p.truth).size.y(); });
  const auto length = values(pairs, [](const Pair& p) { return cuboid(p.mapped).size.x(); });
  const auto both =
      values(pairs, [](const Pair& p) { return 0.5 * size_error(p).head<2>().lpNorm<1>(); });
  result.length_slope = core::fit_line(true_length, length).slope;
  result.size_mae_m = core::mean(both);
  result.constant_size_mae_m = 0.5 * (constant_error(true_length) + constant_error(true_width));
  result.front_right =
      static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [](const Pair& p) {
        return std::abs(heading_error(p)) < std::numbers::pi / 2;
      }));
}

}  // namespace

std::vector<ClassComparison> compare(const ObjectMap& mapped, const ObjectMap& truth,
                                     const ClassTable& table, const ComparisonOptions& options) {
  std::vector<ClassComparison> all;
  for (int i = 0; i < table.size(); ++i) {
    const auto id = static_cast<ClassId>(i);
    ClassComparison result;
    result.name = table[id].name;
    result.shape = table[id].shape;
    if (result.shape != Shape::cuboid && result.shape != Shape::cylinder) continue;
    const auto pairs = paired(id, mapped, truth, options, result);
    for (const Pair& pair : pairs) result.pairs.push_back({pair.mapped->id, pair.truth->id});
    add_errors(pairs, kPlace, result);
    if (result.shape == Shape::cuboid) {
      add_errors(pairs, kCuboid, result);
      add_size_figures(pairs, result);
    } else {
      add_errors(pairs, kCylinder, result);
    }
    all.push_back(std::move(result));
  }
  return all;
}

}  // namespace saker::objects
