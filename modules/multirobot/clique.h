#pragma once

#include <cstdint>
#include <vector>

namespace saker::multirobot {

/// An undirected graph as rows of bits.
class BitGraph {
 public:
  using Row = std::vector<std::uint64_t>;

  explicit BitGraph(int nodes);

  void connect(int a, int b);
  [[nodiscard]] bool connected(int a, int b) const;
  [[nodiscard]] int size() const { return static_cast<int>(rows_.size()); }
  [[nodiscard]] const Row& neighbours(int node) const {
    return rows_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] int degree(int node) const;

 private:
  std::vector<Row> rows_;
};

struct Clique {
  std::vector<int> nodes;  ///< ascending
  bool maximum = true;     ///< false: the search was cut short, a larger one may be there
};

/// The largest set of nodes that are all connected to each other, `excluded` ones left out: branch
/// and bound by greedy colouring (Tomita and Seki, "An Efficient Branch-and-Bound Algorithm for
/// Finding a Maximum Clique", DMTCS 2003). Exact unless it takes more than `most_steps` branches.
[[nodiscard]] Clique maximum_clique(const BitGraph& graph, const std::vector<bool>& excluded,
                                    int most_steps);

}  // namespace saker::multirobot
