#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "saker/active/belief/belief.h"
#include "saker/core/config.h"
#include "saker/objects/class_table.h"
#include "saker/objects/object_map.h"

/// What the tour is for: the prior map's objects of target classes and those that discovery adds,
/// each with the mapped object that it turned out to be.
///
/// Reads the prior map once and the object map at each decision, makes the association of targets
/// and objects. Frames: all in `world`. Method: one to one, most pairs in the gate, of those the
/// nearest (objects/assignment.h). Cost: targets × objects.
namespace saker::active {

struct TargetsConfig {
  double gate_m = 6.0;
  double height_gate_m = 3.0;
  double stood_gate_m = 2.0;
  double keep_m = 1.5;
  double prior_margin_m = 0.5;
  double known_sd_m = 0.1;
  int most_targets = 300;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("gate_m", gate_m, {0.1, 50}, "m",
            "in x-y between prior and mapped place: three deviations of a prior of 2 m");
    v.field("height_gate_m", height_gate_m, {0.1, 50}, "m", "the same in z: about a storey");
    v.field("stood_gate_m", stood_gate_m, {0.1, 50}, "m",
            "in x-y from where a closed target's object stood, once that has left the map: less "
            "than to a neighbour");
    v.field("keep_m", keep_m, {0, 20}, "m",
            "by which another object must be nearer, in sum, for targets to swap theirs");
    v.field("prior_margin_m", prior_margin_m, {0, 10}, "m",
            "kept in view around a target that is not mapped yet, for its place is rough");
    v.field("known_sd_m", known_sd_m, {0, 10}, "m",
            "a prior map that knows length and width so well needs no visit: two of it are the "
            "paper's small error; 0: every target is visited");
    v.field("most_targets", most_targets, {1, 1000}, "",
            "a prior map with more of them is refused: association and tour must fit into a cycle");
  }
};

enum class TargetStatus {
  pending,      ///< to be visited
  done,         ///< seen from enough sides, and mapped
  visited,      ///< the same, but the map has no complete object there: the prior may be wrong
  unreachable,  ///< seen from no side
};

[[nodiscard]] inline const char* to_string(TargetStatus status) {
  constexpr const char* kNames[] = {"pending", "done", "visited", "unreachable"};
  return kNames[static_cast<int>(status)];
}

struct Target {
  int id = -1;  ///< of the prior map's object; of a discovered one: follows the prior's largest
  objects::ClassId class_id = 0;
  Eigen::Vector3d prior_place = Eigen::Vector3d::Zero();  ///< world, m; or where it was discovered
  /// World: the prior's with its margin; placed where its object stood when it was last closed or
  /// put off, once there was one.
  objects::Cuboid expected;
  bool stood = false;      ///< whether there was
  objects::Cuboid extent;  ///< world: its object's, or else `expected`
  Covariance covariance;   ///< of its mapped object, given the poses; empty without one
  int object_id = -1;      ///< the mapped object's; −1: none yet
  int incomplete_id = -1;  ///< of an object there of which nobody saw how long it is; −1: none
  TargetStatus status = TargetStatus::pending;
  std::string reason;       ///< why it is visited with fewer sides, or unreachable
  bool discovered = false;  ///< added: the prior map has none that is it, or another took its place
  bool absent = false;      ///< dismissed: no object is its own any more

  [[nodiscard]] bool mapped() const { return object_id >= 0; }
  [[nodiscard]] bool incomplete() const { return incomplete_id >= 0; }
  [[nodiscard]] Eigen::Vector3d place() const { return extent.pose.translation(); }
  [[nodiscard]] Eigen::Vector3d expected_place() const { return expected.pose.translation(); }
};

/// Whether the prior map has no target: all were discovered.
[[nodiscard]] inline bool without_prior(const std::vector<Target>& targets) {
  return std::ranges::all_of(targets, &Target::discovered);
}

/// The targets in the order of their ids: the prior's, then those that were added. Objects of other
/// classes are passed over; what the prior map knows well (its covariance says so) is closed from
/// the beginning. Throws Error on a place that is not finite, an id that occurs twice, or
/// too many targets.
class TargetList {
 public:
  TargetList(const TargetsConfig& config, const objects::ClassTable& table,
             const objects::ObjectMap& prior);

  /// Gives each target the mapped object of its class that it is: one to one, the most pairs in the
  /// gate, of those the nearest. A target whose object has left the map has none again; a closed
  /// one takes only what stands in its stead, no neighbour. It keeps its object as long as that is
  /// there, for another may not have been seen yet; an unreachable one takes none. An incomplete
  /// object may be a target's as well, which then takes no neighbour's: it is not mapped by it, but
  /// known to be about there.
  void associate(const objects::ObjectMap& map);

  /// Also puts off (pending) and opens again. Remembers where a mapped target's object stands.
  void close(int index, TargetStatus status, std::string reason);

  /// An object that is none of the targets' becomes one: a mapped one, or one of which nobody saw
  /// how long it is. \return its index, the last.
  int add(const objects::MapObject& object, bool complete);

  /// The prior was wrong, nothing of its own is there: closed for good as visited.
  void dismiss(int index, std::string reason);

  /// Changes with `add` and `dismiss`, which come from outside of a policy.
  [[nodiscard]] int revision() const { return revision_; }

  [[nodiscard]] const std::vector<Target>& all() const { return targets_; }
  [[nodiscard]] const Target& operator[](int index) const { return targets_[index]; }
  [[nodiscard]] int size() const { return static_cast<int>(targets_.size()); }
  [[nodiscard]] int count(TargetStatus status) const;

 private:
  [[nodiscard]] double distance(const Target& target, const objects::MapObject& object) const;
  [[nodiscard]] Eigen::MatrixXd costs(const std::vector<const objects::MapObject*>& objects) const;
  void attach(int index, const objects::MapObject* object, bool complete);

  TargetsConfig config_;
  objects::ClassTable table_;
  int next_id_ = 0;
  int revision_ = 0;
  std::vector<Target> targets_;
};

}  // namespace saker::active
