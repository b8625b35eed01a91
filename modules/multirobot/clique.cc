#include "saker/multirobot/clique.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace saker::multirobot {
namespace {

constexpr int kBits = 64;

std::uint64_t bit(int node) { return std::uint64_t{1} << (node % kBits); }
std::size_t word(int node) { return static_cast<std::size_t>(node / kBits); }

/// One node's neighbourhood at a time, renumbered, so that rows stay short.
class Search {
 public:
  Search(const BitGraph& graph, int most_steps) : graph_(graph), steps_left_(most_steps) {}

  /// Looks for a clique with `node` and some of `others` that is larger than the best so far.
  void with(int node, const std::vector<int>& others) {
    if (others.size() < best_.size()) return;
    others_ = &others;
    current_ = {node};
    rows_.assign(others.size(), BitGraph::Row(others.size() / kBits + 1, 0));
    BitGraph::Row all(others.size() / kBits + 1, 0);
    for (int i = 0; i < static_cast<int>(others.size()); ++i) {
      all[word(i)] |= bit(i);
      for (int j = 0; j < i; ++j) {
        if (!graph_.connected(others[static_cast<std::size_t>(i)],
                              others[static_cast<std::size_t>(j)]))
          continue;
        rows_[static_cast<std::size_t>(i)][word(j)] |= bit(j);
        rows_[static_cast<std::size_t>(j)][word(i)] |= bit(i);
      }
    }
    expand(all);
  }

  [[nodiscard]] const std::vector<int>& best() const { return best_; }
  [[nodiscard]] bool cut_short() const { return steps_left_ <= 0; }

 private:
  struct Coloured {
    int node, colour;
  };

  /// Nodes of one colour are not connected: a clique has at most one of each. Ascending colours.
  [[nodiscard]] std::vector<Coloured> colour(BitGraph::Row left) const {
    std::vector<Coloured> coloured;
    for (int colour = 1; std::ranges::any_of(left, [](auto w) { return w != 0; }); ++colour) {
      BitGraph::Row open = left;
      for (std::size_t w = 0; w < open.size(); ++w) {
        while (open[w] != 0) {
          const int node = static_cast<int>(w) * kBits + std::countr_zero(open[w]);
          coloured.push_back({node, colour});
          left[w] &= ~bit(node);
          open[w] &= ~bit(node);
          const BitGraph::Row& row = rows_[static_cast<std::size_t>(node)];
          for (std::size_t v = w; v < open.size(); ++v) open[v] &= ~row[v];
        }
      }
    }
    return coloured;
  }

  void expand(BitGraph::Row candidates) {
    const std::vector<Coloured> order = colour(candidates);
    if (order.empty() && current_.size() > best_.size()) best_ = current_;
    for (auto at = order.rbegin(); at != order.rend(); ++at) {
      if (current_.size() + static_cast<std::size_t>(at->colour) <= best_.size()) return;
      if (--steps_left_ <= 0) return;
      current_.push_back((*others_)[static_cast<std::size_t>(at->node)]);
      BitGraph::Row next = rows_[static_cast<std::size_t>(at->node)];
      for (std::size_t w = 0; w < next.size(); ++w) next[w] &= candidates[w];
      expand(std::move(next));
      current_.pop_back();
      candidates[word(at->node)] &= ~bit(at->node);
    }
  }

  const BitGraph& graph_;
  int steps_left_;
  const std::vector<int>* others_ = nullptr;
  std::vector<BitGraph::Row> rows_;
  std::vector<int> current_, best_;
};

}  // namespace

BitGraph::BitGraph(int nodes)
    : rows_(static_cast<std::size_t>(nodes), Row(static_cast<std::size_t>(nodes / kBits + 1), 0)) {}

void BitGraph::connect(int a, int b) {
  rows_[static_cast<std::size_t>(a)][word(b)] |= bit(b);
  rows_[static_cast<std::size_t>(b)][word(a)] |= bit(a);
}

bool BitGraph::connected(int a, int b) const {
  return (rows_[static_cast<std::size_t>(a)][word(b)] & bit(b)) != 0;
}

int BitGraph::degree(int node) const {
  return std::accumulate(neighbours(node).begin(), neighbours(node).end(), 0,
                         [](int sum, std::uint64_t w) { return sum + std::popcount(w); });
}

Clique maximum_clique(const BitGraph& graph, const std::vector<bool>& excluded, int most_steps) {
  std::vector<int> order, degree;
  for (int node = 0; node < graph.size(); ++node) {
    degree.push_back(graph.degree(node));
    if (!excluded[static_cast<std::size_t>(node)]) order.push_back(node);
  }
  const auto by_degree = [&](int node) { return degree[static_cast<std::size_t>(node)]; };
  std::ranges::stable_sort(order, std::greater{}, by_degree);
  Search search(graph, most_steps);
  std::vector<int> before;  // every clique is found with its last node in `order`
  for (const int node : order) {
    std::vector<int> others;
    for (const int other : before) {
      if (graph.connected(node, other)) others.push_back(other);
    }
    search.with(node, others);
    before.push_back(node);
  }
  std::vector<int> nodes = search.best();
  std::ranges::sort(nodes);
  return {std::move(nodes), !search.cut_short()};
}

}  // namespace saker::multirobot
