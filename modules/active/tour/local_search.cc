#include "saker/active/tour/local_search.h"

#include <algorithm>
#include <numeric>

namespace saker::active {
namespace {

constexpr double kLeastGain = 1e-7;  // below lies rounding
constexpr int kLongestMoved = 3;     // stops that Or-opt moves at once
constexpr double kCheap = 10;        // times the largest cost; no move gains more than three of it

Eigen::MatrixXd closed(const TourProblem& problem) {
  const Eigen::Index stops = problem.from_start.size();
  Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(stops + 2, stops + 2);
  cost.topLeftCorner(stops, stops) = problem.between;
  cost.col(stops).head(stops) = problem.from_start;
  cost.row(stops).head(stops) = problem.from_start.transpose();
  cost.col(stops + 1).head(stops) = problem.to_end;
  cost.row(stops + 1).head(stops) = problem.to_end.transpose();
  const double cheap = -kCheap * (cost.maxCoeff() + 1);
  cost(stops, stops + 1) = cost(stops + 1, stops) = cheap;
  return cost;
}

}  // namespace

LocalSearch::LocalSearch(const TourProblem& problem, const std::vector<int>& order,
                         const TourConfig& config)
    : size_(static_cast<int>(order.size()) + 2),
      start_(size_ - 2),
      end_(size_ - 1),
      segment_(std::min(config.segment, (size_ - 2) / 2)),
      rng_(static_cast<std::uint64_t>(config.seed)),
      cost_(closed(problem)),
      tour_(order),
      position_(size_),
      is_awake_(size_, true) {
  tour_.insert(tour_.begin(), start_);
  tour_.push_back(end_);
  for (int i = 0; i < size_; ++i) position_[tour_[i]] = i;
  awake_.assign(tour_.rbegin(), tour_.rend());
  list_neighbours(std::min(config.neighbours, size_ - 1));
}

void LocalSearch::list_neighbours(int count) {
  neighbours_.resize(size_);
  for (int node = 0; node < size_; ++node) {
    std::vector<int>& list = neighbours_[node];
    list.resize(size_);
    std::iota(list.begin(), list.end(), 0);
    list.erase(list.begin() + node);
    const auto nearer = [&](int a, int b) {
      return std::pair(cost_(a, node), a) < std::pair(cost_(b, node), b);
    };
    std::partial_sort(list.begin(), list.begin() + count, list.end(), nearer);
    list.resize(count);
    list.shrink_to_fit();
  }
}

void LocalSearch::descend() {
  while (!awake_.empty()) {
    const int node = awake_.back();
    awake_.pop_back();
    is_awake_[node] = false;
    while (improve(node)) {
    }
  }
}

int LocalSearch::perturb(int most_kicks, const core::Budget& budget) {
  int kicks = 0;
  for (; kicks < most_kicks && !budget.used_up(kicks); ++kicks) {
    log_.clear();
    gain_ = 0;
    double_bridge();
    descend();
    if (gain_ >= -kLeastGain) continue;
    for (auto done = log_.rbegin(); done != log_.rend(); ++done) reverse(*done);
  }
  return kicks;
}

std::vector<int> LocalSearch::order() const {
  std::vector<int> order;
  const bool forward = next(start_) != end_;
  for (int node = beside(start_, forward); node != start_; node = beside(node, forward)) {
    if (node != end_) order.push_back(node);
  }
  return order;
}

bool LocalSearch::improve(int node) {
  for (const bool forward : {true, false}) {
    if (two_opt(node, forward)) return true;
    Segment segment{node, node, forward};
    for (int length = 1; length <= std::min(kLongestMoved, size_ - 3); ++length) {
      if (or_opt(segment)) return true;
      segment.last = beside(segment.last, forward);
    }
  }
  return false;
}

/// node–after and to–beyond become node–to and after–beyond.
bool LocalSearch::two_opt(int node, bool forward) {
  const int after = beside(node, forward);
  for (const int to : neighbours_[node]) {
    const double nearer = cost_(node, after) - cost_(node, to);
    if (nearer <= kLeastGain) return false;
    const int beyond = beside(to, forward);
    const double gain = nearer + cost_(to, beyond) - cost_(after, beyond);
    if (gain <= kLeastGain) continue;
    gain_ += gain;
    forward ? reverse_path(after, to) : reverse_path(node, beyond);
    wake({node, after, to, beyond});
    return true;
  }
  return false;
}

/// The segment leaves its place; its first node comes to lie beside `to`, its last beside `beyond`.
bool LocalSearch::or_opt(const Segment& segment) {
  const auto [first, last, forward] = segment;
  const int before = beside(first, !forward), after = beside(last, forward);
  const double saved = cost_(before, first) + cost_(last, after) - cost_(before, after);
  const int middle = first == last ? first : beside(first, forward);
  for (const int to : neighbours_[first]) {
    if (cost_(first, to) >= saved - kLeastGain) return false;
    if (to == middle || to == last) continue;
    for (const bool side : {true, false}) {
      const int beyond = beside(to, side);
      if (beyond == first || beyond == last) continue;
      const double gain = saved - cost_(first, to) - cost_(last, beyond) + cost_(to, beyond);
      if (gain <= kLeastGain) continue;
      gain_ += gain;
      move(segment, to, beyond);
      wake({before, after, first, last, to, beyond});
      return true;
    }
  }
  return false;
}

/// In the tour's direction: before [head … tail] after … x y → before after … x [tail … head] y.
void LocalSearch::move(const Segment& segment, int to, int beyond) {
  const int head = segment.forward ? segment.first : segment.last;
  const int tail = segment.forward ? segment.last : segment.first;
  const int before = previous(head), after = next(tail);
  const int x = next(to) == beyond ? to : beyond;
  const bool turned = (x == to) == (segment.first == head) && head != tail;
  reverse_path(head, x);
  reverse_beside(before, x, after);
  if (turned) reverse_beside(x, tail, head);
}

/// Two neighbouring paths change places: p [a … b] [c … d] q → p [c … d] [a … b] q.
void LocalSearch::double_bridge() {
  const int at = rng_.index(size_), first_length = 1 + rng_.index(segment_);
  const auto node = [&](int steps) { return tour_[(at + steps) % size_]; };
  const int p = node(0), a = node(1), b = node(first_length), c = node(first_length + 1);
  const int both = first_length + 1 + rng_.index(segment_);
  const int d = node(both), q = node(both + 1);
  gain_ += cost_(p, a) + cost_(b, c) + cost_(d, q) - cost_(p, c) - cost_(d, a) - cost_(b, q);
  reverse_path(a, d);
  reverse_beside(p, d, c);
  reverse_beside(d, b, a);
  wake({p, a, b, c, d, q});
}

/// The shorter of the path and the rest of the tour: as a closed tour both give the same.
void LocalSearch::reverse_path(int from, int to) {
  const int length = wrapped(position_[to] - position_[from]) + 1;
  const Reversal path{position_[from], length};
  const Reversal rest{wrapped(position_[to] + 1), size_ - length};
  const Reversal& shorter = length <= rest.length ? path : rest;
  reverse(shorter);
  log_.push_back(shorter);
}

void LocalSearch::reverse_beside(int outside, int near, int far) {
  next(outside) == near ? reverse_path(near, far) : reverse_path(far, near);
}

void LocalSearch::reverse(const Reversal& reversal) {
  int low = reversal.first, high = wrapped(reversal.first + reversal.length - 1);
  for (int swaps = reversal.length / 2; swaps > 0; --swaps) {
    std::swap(tour_[low], tour_[high]);
    position_[tour_[low]] = low;
    position_[tour_[high]] = high;
    low = wrapped(low + 1);
    high = wrapped(high - 1);
  }
}

void LocalSearch::wake(std::initializer_list<int> nodes) {
  for (const int node : nodes) {
    if (is_awake_[node]) continue;
    is_awake_[node] = true;
    awake_.push_back(node);
  }
}

}  // namespace saker::active
