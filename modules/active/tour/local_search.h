#pragma once

#include <vector>

#include "saker/active/tour/tour.h"
#include "saker/core/rng.h"

namespace saker::active {

/// 2-opt, Or-opt and double bridges on one tour (tour.h names the sources).
///
/// Reads costs and an order, makes a shorter order; no frame, any unit. Cost: see tour.h.
/// The path is a closed tour: its start and its end are two nodes more, joined by an edge so cheap
/// that no improvement removes it. Every move is a series of reversals of paths, so that a
/// perturbation that does not pay is taken back by doing the same reversals again.
class LocalSearch {
 public:
  /// \param order where to begin: each stop once, two stops at least.
  LocalSearch(const TourProblem& problem, const std::vector<int>& order, const TourConfig& config);

  /// To a tour that no move of a node that was woken shortens; at first that is each of them.
  void descend();

  /// Double bridges, each followed by a descent and kept unless the tour is longer.
  /// \return how many were tried: fewer than `most_kicks` when the budget is used up.
  int perturb(int most_kicks, const core::Budget& budget);

  [[nodiscard]] std::vector<int> order() const;

 private:
  /// Of the nodes on `length` positions from `first` on; done twice it changes nothing.
  struct Reversal {
    int first, length;
  };
  /// One to three nodes that follow each other, `first` being the one that gets a new neighbour.
  struct Segment {
    int first, last;
    bool forward;  ///< `last` comes after `first`
  };

  [[nodiscard]] int next(int node) const { return tour_[wrapped(position_[node] + 1)]; }
  [[nodiscard]] int previous(int node) const { return tour_[wrapped(position_[node] - 1)]; }
  [[nodiscard]] int beside(int node, bool forward) const {
    return forward ? next(node) : previous(node);
  }
  [[nodiscard]] int wrapped(int position) const {
    return position < 0 ? position + size_ : position >= size_ ? position - size_ : position;
  }

  void list_neighbours(int count);
  [[nodiscard]] bool improve(int node);
  [[nodiscard]] bool two_opt(int node, bool forward);
  [[nodiscard]] bool or_opt(const Segment& segment);
  void move(const Segment& segment, int to, int beyond);
  void double_bridge();

  void reverse_path(int from, int to);                  ///< from `from` forward to `to`
  void reverse_beside(int outside, int near, int far);  ///< the path near … far next to `outside`
  void reverse(const Reversal& reversal);
  void wake(std::initializer_list<int> nodes);

  int size_;
  int start_, end_;
  int segment_;
  core::Rng rng_;
  Eigen::MatrixXd cost_;
  std::vector<std::vector<int>> neighbours_;  ///< nearest first
  std::vector<int> tour_;                     ///< nodes in their order
  std::vector<int> position_;                 ///< of each node in it
  std::vector<int> awake_;                    ///< without don't-look bit
  std::vector<bool> is_awake_;
  std::vector<Reversal> log_;  ///< since the last perturbation
  double gain_ = 0;            ///< since the last perturbation
};

}  // namespace saker::active
