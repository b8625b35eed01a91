#include "slam/flight_lengths.h"

#include <algorithm>
#include <set>

#include "objects/stated_length.h"

namespace saker::slam {
namespace {

/// One flight's estimate of a landmark, by its number in the list.
struct Vote {
  std::size_t of = 0;
  Landmark landmark;
};

bool from_near(const Observation& observation, double near_m) {
  return objects::place(observation.measured.model).head<2>().norm() <= near_m;
}

/// One for each flight that saw it from near by; none where only one flight saw it at all.
std::vector<Vote> votes_on(const Landmark& landmark, std::size_t number, double near_m) {
  std::vector<Vote> votes;
  if (!is_cuboid(landmark.model)) return votes;
  std::set<int> all, near;
  for (const Observation& o : landmark.observations) {
    all.insert(o.chain);
    if (from_near(o, near_m)) near.insert(o.chain);
  }
  if (all.size() < 2) return votes;
  for (const int flight : near) {
    Vote& vote = votes.emplace_back(Vote{number, landmark});
    std::erase_if(vote.landmark.observations,
                  [&](const Observation& o) { return o.chain != flight || !from_near(o, near_m); });
  }
  return votes;
}

/// Between where and where a vehicle lies along an axis, from a point of it.
struct Span {
  double middle = 0, length = 0;
};

Span span_of(const objects::Cuboid& cuboid, const objects::Cuboid& reference, int longer) {
  const Eigen::Vector3d axis = reference.pose.linear().col(longer);
  const Eigen::Vector3d away = cuboid.pose.translation() - reference.pose.translation();
  return {axis.dot(away), cuboid.size[longer]};
}

/// The mean that weighs a shorter one's squared error by `shorter`; its middle with the same
/// weights. Exact after at most as many steps as there are spans.
Span asymmetric_mean(const std::vector<Span>& spans, double shorter) {
  Span mean{0, std::ranges::max_element(spans, {}, &Span::length)->length};
  for (std::size_t step = 0; step <= spans.size(); ++step) {
    Span sum;
    double weights = 0;
    for (const Span& span : spans) {
      const double weight = span.length < mean.length ? shorter : 1;
      sum.middle += weight * span.middle;
      sum.length += weight * span.length;
      weights += weight;
    }
    mean = {sum.middle / weights, sum.length / weights};
  }
  return mean;
}

void set_span(objects::Cuboid& cuboid, const Span& span, int longer) {
  cuboid.pose.translation() += span.middle * cuboid.pose.linear().col(longer);
  cuboid.size[longer] = span.length;
}

/// With the poses where they are: of each chain a copy moves its newest keyframe, for a graph
/// without a pose that moves is not solved.
bool solve_held(Chains chains, const std::vector<Landmark*>& landmarks, const GraphConfig& config,
                const core::Budget& budget) {
  std::vector<std::vector<Keyframe>> keyframes;
  for (const Chain& chain : chains) keyframes.push_back(*chain.keyframes);
  std::vector<Chain> held;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    held.push_back({&keyframes[c], chains[c].prior, keyframes[c].size() - 1});
  }
  return solve_graph(held, landmarks, config, budget).usable;
}

}  // namespace

void weigh_flights(std::vector<Landmark>& landmarks, Chains chains, const GraphConfig& graph,
                   const MergeConfig& config, const core::Budget& budget) {
  std::vector<Vote> votes;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    std::ranges::move(votes_on(landmarks[i], i, config.near_m), std::back_inserter(votes));
  }
  if (votes.empty()) return;
  std::vector<Landmark*> solved;
  for (Vote& vote : votes) solved.push_back(&vote.landmark);
  if (!solve_held(chains, solved, graph, budget)) return;
  for (auto first = votes.begin(); first != votes.end();) {
    const auto last =
        std::find_if(first, votes.end(), [&](const Vote& v) { return v.of != first->of; });
    auto& vehicle = std::get<objects::Cuboid>(landmarks[first->of].model);
    const int longer = longer_axis(vehicle);
    std::vector<Span> spans;
    for (; first != last; ++first) {
      spans.push_back(span_of(std::get<objects::Cuboid>(first->landmark.model), vehicle, longer));
    }
    set_span(vehicle, asymmetric_mean(spans, config.shorter_flight), longer);
  }
}

}  // namespace saker::slam
