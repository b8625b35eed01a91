#pragma once

#include "saker/active/belief/knowledge.h"

namespace saker::active {

/// What is known of one target: by its views, by the map, and by the less certain of both.
///
/// Reads the target with the map's covariance, and its views. Where the map knows less than the
/// views should have measured, they contradict each other, and the map is believed. The map is
/// late: it does not hold the last views yet, and counts as if it did. Frames: covariances of [x,
/// y, length, width] in the target's own frame, m². Cost: one prediction for each dwell. Refers to
/// all that it is made from.
class TargetBelief {
 public:
  TargetBelief(const Target& target, const MappedViewHistory& history, const ViewModel& model,
               const PamsConfig& config);

  [[nodiscard]] const Knowledge& by_views() const { return by_views_; }

  /// By its views, or by the map where that knows less.
  [[nodiscard]] Belief belief() const;

  /// What the map will have of it once it holds the views `until`.
  [[nodiscard]] Belief in_map(const ViewHistory& until) const;

  /// To `share` of the greatest sd, by the map, or by its views where that says nothing. The place
  /// of a cylinder says all.
  [[nodiscard]] bool size_is_known(double share) const;

  /// The entropy threshold is reached, the size is known, and the class is sure.
  /// \param map  says how probable the class is; may be null.
  [[nodiscard]] bool is_enough(const objects::ObjectMap* map) const;

 private:
  [[nodiscard]] double class_probability(const objects::ObjectMap* map) const;

  const Target& target_;
  const MappedViewHistory& history_;
  const ViewModel& model_;
  const PamsConfig& config_;
  Knowledge by_views_;
};

}  // namespace saker::active
