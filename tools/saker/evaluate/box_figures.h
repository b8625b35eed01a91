#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Points that are called vehicle against labelled boxes. Reads the points of a scan, which of them
/// are called vehicle, and the scan's boxes, all in its lidar frame; makes counts of recognised
/// boxes by kind, and the share of the called points that lie in a box. Cost: 1 ms for ten boxes
/// and 120,000 points.
namespace saker::tools {

/// A labelled box of a vehicle.
struct LabelledBox {
  std::string kind;                                           ///< car, van, truck, bus or other
  std::string vehicle;                                        ///< its identity over scans, or empty
  Eigen::Vector3d position = Eigen::Vector3d::Constant(NAN);  ///< of the centre, m
  Eigen::Vector3d size = Eigen::Vector3d::Constant(NAN);      ///< length, width, height, m
  double yaw = NAN;                                           ///< rad

  /// Whether p lies inside the box grown by `margin_m` on every side.
  [[nodiscard]] bool holds(const Eigen::Vector3d& p, double margin_m) const;
};

/// The kind of vehicle that the name of a data set's class means: "Medium-sized Truck" is a truck.
/// Nothing where it names no vehicle with four wheels or more.
[[nodiscard]] std::optional<std::string> vehicle_kind(const std::string& class_name);

/// Which boxes and points count.
struct BoxRules {
  double range_m = 40;         ///< horizontal, from the sensor
  int least_points = 50;       ///< of a box that counts
  double least_share = 0.5;    ///< of its points, of a box that is recognised
  double own_margin_m = 0.05;  ///< points so near a box are its own
  double margin_m = 0.4;       ///< points so near a box are not wrong
};

/// What became of one scan.
struct BoxJudgement {
  enum class Of { uncounted, recognised, missed };
  std::vector<Of> boxes;         ///< one a box
  std::vector<bool> judged;      ///< one a point: in range, and where boxes are labelled
  std::vector<bool> in_box;      ///< one a point: in a box grown by the margin
  std::vector<bool> in_counted;  ///< one a point: own point of a box that counts
};

class BoxFigures {
 public:
  struct OfKind {
    int boxes = 0;
    int recognised = 0;
    double sum_of_shares = 0;  ///< of each box's points that are called vehicle
    std::map<std::string, Eigen::Vector2i>
        vehicles;  ///< boxes and recognised ones of each identity

    [[nodiscard]] double recall() const;
    [[nodiscard]] double mean_share() const;
    /// Vehicles of which at least half the boxes are recognised; one without identity is its own.
    [[nodiscard]] int recognised_vehicles() const;
  };

  explicit BoxFigures(const BoxRules& rules = {}) : rules_(rules) {}

  /// \param called  one a point: whether it is called vehicle.
  /// \param half_angle_deg  boxes are labelled only so far to either side of the x axis.
  BoxJudgement add(const std::vector<Eigen::Vector3f>& points, const std::vector<bool>& called,
                   const std::vector<LabelledBox>& boxes, std::optional<float> half_angle_deg);

  [[nodiscard]] const std::map<std::string, OfKind>& kinds() const { return kinds_; }
  /// Of the points that are called vehicle, those in a box grown by the margin; NaN of none.
  [[nodiscard]] double point_precision() const;
  [[nodiscard]] long called_points() const { return called_; }

 private:
  BoxRules rules_;
  std::map<std::string, OfKind> kinds_;
  long called_ = 0, right_ = 0;
};

}  // namespace saker::tools
