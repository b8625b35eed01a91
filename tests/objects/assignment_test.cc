#include "saker/objects/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "saker/core/rng.h"

namespace saker::objects {
namespace {

Eigen::MatrixXd random_costs(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  core::Rng rng(seed);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return rng.uniform(); });
}

int pairs(const std::vector<int>& column_of) {
  return static_cast<int>(std::ranges::count_if(column_of, [](int column) { return column >= 0; }));
}

double sum(const Eigen::MatrixXd& cost, const std::vector<int>& column_of) {
  double sum = 0;
  for (std::size_t i = 0; i < column_of.size(); ++i) {
    if (column_of[i] >= 0) sum += cost(static_cast<Eigen::Index>(i), column_of[i]);
  }
  return sum;
}

TEST(Assignment, IsTheBestOfAllPermutations) {
  core::Rng rng(4);
  for (int trial = 0; trial < 30; ++trial) {
    const Eigen::MatrixXd cost = Eigen::MatrixXd::NullaryExpr(5, 5, [&] { return rng.uniform(); });
    const std::vector<int> column_of = assign(cost, 2);
    double sum = 0, best = 1e9;
    for (int i = 0; i < 5; ++i) sum += cost(i, column_of[static_cast<std::size_t>(i)]);
    std::vector<int> order = {0, 1, 2, 3, 4};
    do {
      double other = 0;
      for (int i = 0; i < 5; ++i) other += cost(i, order[static_cast<std::size_t>(i)]);
      best = std::min(best, other);
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_NEAR(sum, best, 1e-12);
  }
}

TEST(Assignment, PairsAsManyAsTheGateAllows) {
  Eigen::MatrixXd cost(2, 3);
  cost << 0.1, 1.0, 9, 0.2, 9, 9;  // the nearest pair first would leave row 1 alone
  EXPECT_EQ(assign(cost, 1.5), (std::vector<int>{1, 0}));
  EXPECT_EQ(assign(cost, 0.15), (std::vector<int>{0, -1}));
  EXPECT_EQ(assign(Eigen::MatrixXd(2, 0), 1), (std::vector<int>{-1, -1}));
}

TEST(Assignment, GivesNoColumnTwice) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::set<int> columns;
    for (const int column : assign(random_costs(7, 9, seed), 0.4)) {
      if (column >= 0) {
        EXPECT_TRUE(columns.insert(column).second) << seed;
      }
    }
  }
}

TEST(Assignment, PairsNothingBeyondTheGate) {
  const Eigen::MatrixXd cost = random_costs(8, 8, 1);
  const std::vector<int> column_of = assign(cost, 0.2);
  for (std::size_t i = 0; i < column_of.size(); ++i) {
    if (column_of[i] >= 0) {
      EXPECT_LE(cost(static_cast<Eigen::Index>(i), column_of[i]), 0.2);
    }
  }
  EXPECT_EQ(pairs(assign(cost, -1)), 0);
}

TEST(Assignment, IsTheSameFromTheOtherSide) {
  for (const auto& [rows, columns] : {std::pair{6, 6}, {4, 9}, {9, 4}}) {
    const Eigen::MatrixXd cost = random_costs(rows, columns, 2);
    const std::vector<int> column_of = assign(cost, 0.7), row_of = assign(cost.transpose(), 0.7);
    for (std::size_t i = 0; i < column_of.size(); ++i) {
      if (column_of[i] < 0) continue;
      EXPECT_EQ(row_of[static_cast<std::size_t>(column_of[i])], static_cast<int>(i));
    }
    EXPECT_EQ(pairs(column_of), pairs(row_of));
  }
}

TEST(Assignment, AWiderGateLosesNoPair) {
  const Eigen::MatrixXd cost = random_costs(10, 10, 3);
  int last = 0;
  for (double gate = 0; gate < 1; gate += 0.05) {
    const int now = pairs(assign(cost, gate));
    EXPECT_GE(now, last) << gate;
    last = now;
  }
  EXPECT_EQ(last, 10);
}

TEST(Assignment, IsNoWorseThanTheNearestFirst) {
  const Eigen::MatrixXd cost = random_costs(40, 40, 5);
  std::vector<int> nearest_first(40, -1);
  Eigen::MatrixXd left = cost;
  for (int k = 0; k < 40; ++k) {
    Eigen::Index row = 0, column = 0;
    left.minCoeff(&row, &column);
    nearest_first[static_cast<std::size_t>(row)] = static_cast<int>(column);
    left.row(row).setConstant(1e9);
    left.col(column).setConstant(1e9);
  }
  EXPECT_LT(sum(cost, assign(cost, 2)), sum(cost, nearest_first));
}

TEST(Assignment, ACostThatIsNoNumberPairsNothing) {
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(2, 2, NAN);
  cost(1, 0) = 0.5;
  EXPECT_EQ(assign(cost, 1), (std::vector<int>{-1, 0}));
}

}  // namespace
}  // namespace saker::objects
