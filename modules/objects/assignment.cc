#include "saker/objects/assignment.h"

#include <algorithm>
#include <limits>

namespace saker::objects {
namespace {

/// Square and filled up so that an out-of-gate pair costs more than any choice among those in the
/// gate.
Eigen::MatrixXd padded(const Eigen::MatrixXd& cost, double gate) {
  const Eigen::Index size = std::max(cost.rows(), cost.cols());
  const double never = (gate + 1) * static_cast<double>(size + 1);
  Eigen::MatrixXd square = Eigen::MatrixXd::Constant(size, size, never);
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      if (cost(i, j) <= gate) square(i, j) = cost(i, j);
    }
  }
  return square;
}

/// Shortest augmenting paths. Rows and columns count from 1; column 0 holds the row that looks for
/// a place.
class Augmentation {
 public:
  explicit Augmentation(const Eigen::MatrixXd& cost)
      : cost_(cost),
        size_(static_cast<std::size_t>(cost.rows())),
        row_potential_(size_ + 1, 0),
        column_potential_(size_ + 1, 0),
        row_of_(size_ + 1, 0),
        before_(size_ + 1, 0) {}

  /// Row of each column, from 1; entry 0 means nothing.
  std::vector<std::size_t> solve() {
    for (std::size_t row = 1; row <= size_; ++row) {
      std::size_t column = path_for(row);
      for (; column != 0; column = before_[column]) row_of_[column] = row_of_[before_[column]];
    }
    return row_of_;
  }

 private:
  std::size_t path_for(std::size_t row) {
    least_.assign(size_ + 1, std::numeric_limits<double>::infinity());
    used_.assign(size_ + 1, false);
    row_of_[0] = row;
    std::size_t column = 0;
    do {
      used_[column] = true;
      column = extend(column);
    } while (row_of_[column] != 0);
    return column;
  }

  /// Relaxes the edges of the row in `column`, shifts the potentials; the next column of the path.
  std::size_t extend(std::size_t column) {
    const std::size_t row = row_of_[column];
    std::size_t next = 0;
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t j = 1; j <= size_; ++j) {
      if (used_[j]) continue;
      const double reduced =
          cost_(static_cast<Eigen::Index>(row - 1), static_cast<Eigen::Index>(j - 1)) -
          row_potential_[row] - column_potential_[j];
      if (reduced < least_[j]) least_[j] = reduced, before_[j] = column;
      if (least_[j] < step) step = least_[j], next = j;
    }
    for (std::size_t j = 0; j <= size_; ++j) {
      if (used_[j]) {
        row_potential_[row_of_[j]] += step;
        column_potential_[j] -= step;
      } else {
        least_[j] -= step;
      }
    }
    return next;
  }

  const Eigen::MatrixXd& cost_;
  std::size_t size_;
  std::vector<double> row_potential_, column_potential_, least_;
  std::vector<std::size_t> row_of_, before_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<int> assign(const Eigen::MatrixXd& cost, double gate) {
  std::vector<int> column_of(static_cast<std::size_t>(cost.rows()), -1);
  if (cost.size() == 0) return column_of;
  const Eigen::MatrixXd square = padded(cost, gate);
  const std::vector<std::size_t> row_of = Augmentation(square).solve();
  for (std::size_t column = 1; column <= static_cast<std::size_t>(cost.cols()); ++column) {
    const auto i = static_cast<Eigen::Index>(row_of[column]) - 1,
               j = static_cast<Eigen::Index>(column) - 1;
    if (i < cost.rows() && cost(i, j) <= gate)
      column_of[static_cast<std::size_t>(i)] = static_cast<int>(j);
  }
  return column_of;
}

}  // namespace saker::objects
