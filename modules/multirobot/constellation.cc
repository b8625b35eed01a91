#include "saker/multirobot/constellation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/multirobot/alignment_evidence.h"
#include "saker/multirobot/clique.h"

namespace saker::multirobot {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

using Stars = std::vector<Star>;

/// Distances between all objects of a map, in x-y.
Eigen::MatrixXd distances(const Stars& stars) {
  const auto n = static_cast<Eigen::Index>(stars.size());
  Eigen::MatrixXd all(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      all(i, j) =
          (stars[static_cast<std::size_t>(i)].place - stars[static_cast<std::size_t>(j)].place)
              .head<2>()
              .norm();
    }
  }
  return all;
}

/// The search for alignments of b to a.
class Search {
 public:
  Search(const Comparison& maps, const ConstellationConfig& config,
         const std::optional<AlignmentBounds>& bounds)
      : a_(maps.a()), b_(maps.b()), config_(config), bounds_(bounds) {
    for (std::size_t i = 0; i < a_.size(); ++i) {
      for (std::size_t j = 0; j < b_.size(); ++j) {
        if (alike(a_[i], b_[j])) nodes_.push_back({static_cast<int>(i), static_cast<int>(j)});
      }
    }
  }

  [[nodiscard]] const std::vector<Match>& nodes() const { return nodes_; }

  /// Which matches may hold together.
  [[nodiscard]] BitGraph consistent() const {
    const Eigen::MatrixXd between_a = distances(a_), between_b = distances(b_);
    BitGraph graph(static_cast<int>(nodes_.size()));
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      for (std::size_t m = n + 1; m < nodes_.size(); ++m) {
        const Match &x = nodes_[n], &y = nodes_[m];
        if (x.a == y.a || x.b == y.b) continue;
        const double gap = between_a(x.a, y.a) - between_b(x.b, y.b);
        if (std::abs(gap) > config_.gate * sd(x, y)) continue;
        if (consistent(x, y)) graph.connect(static_cast<int>(n), static_cast<int>(m));
      }
    }
    return graph;
  }

 private:
  [[nodiscard]] const Star& a(const Match& m) const { return a_[static_cast<std::size_t>(m.a)]; }
  [[nodiscard]] const Star& b(const Match& m) const { return b_[static_cast<std::size_t>(m.b)]; }

  [[nodiscard]] bool alike(const Star& a, const Star& b) const {
    if (a.class_id != b.class_id || a.cuboid != b.cuboid) return false;
    const double gate = config_.gate * std::numbers::sqrt2;
    const double sd = a.cuboid ? config_.size_sd_m : config_.radius_sd_m;
    if ((a.size - b.size).cwiseAbs().maxCoeff() > gate * sd) return false;
    if (!bounds_) return true;
    if ((a.place - b.place).head<2>().norm() > bounds_->shift_m) return false;
    const double turn = bounds_->turn_deg + gate * config_.heading_sd_deg;
    return !a.cuboid || std::abs(half_turn(a.heading - b.heading)) <= turn * kRadian;
  }

  [[nodiscard]] double sd(const Match& x, const Match& y) const {
    return std::hypot(std::hypot(a(x).sd, b(x).sd), std::hypot(a(y).sd, b(y).sd));
  }

  /// Heights, and the turn that both headings and the line between the places ask for.
  [[nodiscard]] bool consistent(const Match& x, const Match& y) const {
    const Eigen::Vector3d da = a(y).place - a(x).place, db = b(y).place - b(x).place;
    const double tolerance = config_.gate * sd(x, y);
    if (std::abs(da.z() - db.z()) > tolerance) return false;
    const double turn = std::atan2(da.y(), da.x()) - std::atan2(db.y(), db.x());
    const double sure = tolerance / std::max(da.head<2>().norm(), tolerance);
    const double gate =
        sure + config_.gate * std::numbers::sqrt2 * config_.heading_sd_deg * kRadian;
    if (bounds_) {
      const double least = std::remainder(turn, 2 * std::numbers::pi);
      if (std::abs(least) > bounds_->turn_deg * kRadian + sure) return false;
    }
    for (const Match& m : {x, y}) {
      if (a(m).cuboid && std::abs(half_turn(a(m).heading - b(m).heading - turn)) > gate)
        return false;
    }
    return true;
  }

  const Stars &a_, &b_;
  const ConstellationConfig& config_;
  const std::optional<AlignmentBounds>& bounds_;
  std::vector<Match> nodes_;
};

/// What the alignment explains is no part of another one.
void exclude(const Comparison& maps, const std::vector<Match>& nodes, const SE3& T_a_b,
             const ConstellationConfig& config, std::vector<bool>& excluded) {
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Star& a = maps.a()[static_cast<std::size_t>(nodes[n].a)];
    const Star& b = maps.b()[static_cast<std::size_t>(nodes[n].b)];
    const double gap = (a.place - T_a_b * b.place).head<2>().norm();
    if (gap <= 2 * config.gate * std::hypot(a.sd, b.sd)) excluded[n] = true;
  }
}

/// Bayes' rule over the hypotheses and that the maps have nothing in common.
double probability_wrong(const std::vector<Comparison::Hypothesis>& all, std::size_t best) {
  const double highest = std::max(all[best].log_odds, 0.0);
  double wrong = std::exp(-highest);
  for (std::size_t h = 0; h < all.size(); ++h) {
    if (h != best) wrong += std::exp(all[h].log_odds - highest);
  }
  return wrong / (wrong + std::exp(all[best].log_odds - highest));
}

Alignment judged(const Comparison& maps, const std::vector<Comparison::Hypothesis>& all,
                 const ConstellationConfig& config) {
  const auto by_odds = [](const auto& x, const auto& y) { return x.log_odds < y.log_odds; };
  const auto best = std::ranges::max_element(all, by_odds);
  Alignment result;
  result.T_a_b = best->T_a_b;
  result.evidence = best->log_odds;
  result.next_evidence = -std::numeric_limits<double>::infinity();
  for (const auto& other : all) {
    if (&other != &*best) result.next_evidence = std::max(result.next_evidence, other.log_odds);
  }
  for (const Match& m : best->matches) {
    result.matches.emplace_back(maps.a()[static_cast<std::size_t>(m.a)].id,
                                maps.b()[static_cast<std::size_t>(m.b)].id);
  }
  result.probability_wrong = probability_wrong(all, static_cast<std::size_t>(best - all.begin()));
  if (static_cast<int>(best->matches.size()) < config.least_matches) {
    result.status = AlignmentStatus::too_few;
  } else if (result.probability_wrong > config.most_wrong) {
    result.status = AlignmentStatus::ambiguous;
  } else {
    result.status = AlignmentStatus::accepted;
  }
  return result;
}

}  // namespace

std::string to_string(AlignmentStatus status) {
  switch (status) {
    case AlignmentStatus::accepted:
      return "accepted";
    case AlignmentStatus::too_few:
      return "too few objects in common";
    case AlignmentStatus::ambiguous:
      return "ambiguous";
    case AlignmentStatus::too_large:
      return "too large to search";
  }
  return "";
}

Alignment align(const Survey& a, const Survey& b, const ConstellationConfig& config,
                const std::optional<AlignmentBounds>& bounds) {
  Alignment refused;
  const Comparison maps(a, b, config);
  const Search search(maps, config, bounds);
  const std::vector<Match>& nodes = search.nodes();
  if (static_cast<int>(nodes.size()) > config.most_candidates) {
    refused.status = AlignmentStatus::too_large;
    return refused;
  }
  const BitGraph graph = search.consistent();
  std::vector<bool> excluded(nodes.size(), false);
  std::vector<Comparison::Hypothesis> hypotheses;
  for (int h = 0; h < config.hypotheses; ++h) {
    const Clique clique = maximum_clique(graph, excluded, config.most_steps);
    if (!clique.maximum) {
      refused.status = AlignmentStatus::too_large;
      return refused;
    }
    if (clique.nodes.size() < 3) break;
    std::vector<Match> seed;
    for (const int node : clique.nodes) seed.push_back(nodes[static_cast<std::size_t>(node)]);
    hypotheses.push_back(maps.grown(seed, bounds));
    exclude(maps, nodes, hypotheses.back().T_a_b.pose, config, excluded);
    for (const int node : clique.nodes) excluded[static_cast<std::size_t>(node)] = true;
  }
  return hypotheses.empty() ? refused : judged(maps, hypotheses, config);
}

}  // namespace saker::multirobot
