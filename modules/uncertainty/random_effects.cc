#include "saker/uncertainty/random_effects.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace saker::uncertainty {
namespace {

// Of errors of at most four entries: nothing is allocated in the loops.
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

/// What is known of what an object adds to all its measurements.
struct Addition {
  Vector mean;
  Matrix covariance;
};

Vector flipped(const Vector& signs, const Vector& v) { return v.cwiseProduct(signs); }
Matrix flipped(const Vector& signs, const Matrix& m) {
  return signs.asDiagonal() * m * signs.asDiagonal();
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }

class Estimation {
 public:
  Estimation(std::span<const Draw> draws, std::span<const Eigen::VectorXd> alike,
             const Eigen::VectorXd& parity, const RandomEffectsConfig& config)
      : draws_(draws),
        alike_(alike.begin(), alike.end()),
        parity_(parity),
        config_(config),
        weights_(draws.size(), 1.0) {
    int objects = 0;
    for (const Draw& draw : draws) objects = std::max(objects, draw.object + 1);
    for (const Draw& draw : draws) errors_.push_back(draw.error);
    additions_.assign(at(objects), {zero_vector(), zero_matrix()});
    counts_.assign(alike.size(), 0);
    for (const Draw& draw : draws) ++counts_[at(draw.interval)];
    start(alike.size());
  }

  /// \return how much the common covariance changed, relative to itself
  double iterate() {
    const Matrix before = common_;
    fill_in();
    weigh();
    estimate_additions();
    estimate_biases();
    estimate_covariances();
    estimate_common();
    return (common_ - before).norm() / before.norm();
  }

  [[nodiscard]] RandomEffects result() {
    fill_in();
    RandomEffects result;
    result.draws = counts_;
    result.common = common_;
    result.errors = errors_;
    for (std::size_t i = 0; i < bias_.size(); ++i) {
      result.bias.emplace_back(bias_[i]);
      const double known = counts_[i] + config_.bias_prior_draws;
      result.covariance.emplace_back(covariance_[i] * (known > 0 ? 1 + 1 / known : 1));
    }
    return result;
  }

 private:
  [[nodiscard]] Vector zero_vector() const { return Vector::Zero(parity_.size()); }
  [[nodiscard]] Matrix zero_matrix() const { return Matrix::Zero(parity_.size(), parity_.size()); }
  [[nodiscard]] Matrix least() const {
    return config_.least_sd_m * config_.least_sd_m *
           Matrix::Identity(parity_.size(), parity_.size());
  }

  /// From the object's own frame to "as if seen from the left", and back.
  template <class T>
  [[nodiscard]] T folded(const Draw& draw, const T& own) const {
    return draw.mirrored ? flipped(parity_, own) : own;
  }
  /// From an interval to what all are alike in, and back.
  template <class T>
  [[nodiscard]] T alike(std::size_t interval, const T& own) const {
    return flipped(alike_[interval], own);
  }

  [[nodiscard]] std::vector<Matrix> inverse_covariances() const {
    std::vector<Matrix> inverse;
    for (const Matrix& covariance : covariance_) inverse.emplace_back(covariance.inverse());
    return inverse;
  }

  [[nodiscard]] Vector rest_of(std::size_t i) const {
    return Vector(errors_[i]) - bias_[at(draws_[i].interval)];
  }

  /// What a draw leaves open: as what it says lets expect it by the present estimates.
  void fill_in() {
    const std::vector<Matrix> known = inverse_covariances();
    for (std::size_t i = 0; i < draws_.size(); ++i) {
      const Draw& draw = draws_[i];
      if (draw.open.size() == 0) continue;
      const Vector expected =
          bias_[at(draw.interval)] + folded(draw, additions_[at(draw.object)].mean);
      const Vector rest = draw.error - expected;
      errors_[i] = expected + said(draw, known[at(draw.interval)]) * rest;
    }
  }

  /// Of an error with that information: onto what a draw says of it, the open rest by regression.
  [[nodiscard]] Matrix said(const Draw& draw, const Matrix& information) const {
    return Matrix::Identity(parity_.size(), parity_.size()) -
           left_open(draw, information) * information;
  }

  /// Variance of what it leaves open.
  [[nodiscard]] Matrix left_open(const Draw& draw, const Matrix& information) const {
    if (draw.open.size() == 0) return zero_matrix();
    const Vector open = draw.open;
    return open * open.transpose() / open.dot(information * open);
  }

  /// All intervals alike, half of the variance common; by the draws that leave nothing open.
  void start(std::size_t intervals) {
    std::vector<Vector> errors;
    for (const Draw& draw : draws_) {
      if (draw.open.size() == 0) errors.emplace_back(draw.error);
    }
    if (errors.empty()) errors.assign(errors_.begin(), errors_.end());
    const double share = 1 / static_cast<double>(errors.size());
    Vector mean = zero_vector();
    for (const Vector& error : errors) mean += share * error;
    Matrix covariance = least();
    for (const Vector& error : errors) {
      const Vector rest = error - mean;
      covariance += share * rest * rest.transpose();
    }
    class_bias_ = mean;
    location_.assign(intervals, mean);
    bias_.assign(intervals, mean);
    covariance_.assign(intervals, 0.5 * covariance);
    common_ = 0.25 * (covariance + flipped(parity_, covariance));
  }

  /// One step of Huber's M-estimator of location (Annals of Mathematical Statistics 35, 1964),
  /// entry by entry, in units of the median deviation.
  [[nodiscard]] Vector located(const std::vector<Vector>& values, const Vector& location) const {
    Vector moved = location;
    std::vector<double> deviations(values.size());
    for (Eigen::Index k = 0; k < location.size(); ++k) {
      std::ranges::transform(values, deviations.begin(),
                             [&](const Vector& v) { return std::abs(v[k] - location[k]); });
      std::ranges::nth_element(deviations, deviations.begin() + deviations.size() / 2);
      const double most = config_.bias_most_deviations * deviations[deviations.size() / 2];
      double sum = 0;
      for (const Vector& v : values) sum += std::clamp(v[k] - location[k], -most, most);
      moved[k] += sum / static_cast<double>(values.size());
    }
    return moved;
  }

  /// Bounds what an outlier moves.
  void weigh() {
    std::vector<Matrix> information;
    for (const Matrix& covariance : covariance_) {
      information.emplace_back((covariance + common_).inverse());
    }
    for (std::size_t i = 0; i < draws_.size(); ++i) {
      const Matrix& known = information[at(draws_[i].interval)];
      const Vector rest = said(draws_[i], known) * rest_of(i);
      const double squared = rest.dot(known * rest);
      weights_[i] = std::min(1.0, config_.most_sd * config_.most_sd / squared);
    }
  }

  void estimate_additions() {
    const std::vector<Matrix> known = inverse_covariances();
    std::vector<Matrix> information(additions_.size(), common_.inverse());
    std::vector<Vector> weighted(additions_.size(), zero_vector());
    for (std::size_t i = 0; i < draws_.size(); ++i) {
      const Draw& draw = draws_[i];
      const Matrix& all = known[at(draw.interval)];
      const Matrix own = folded(draw, Matrix(weights_[i] * all * said(draw, all)));
      information[at(draw.object)] += own;
      weighted[at(draw.object)] += own * folded(draw, rest_of(i));
    }
    for (std::size_t i = 0; i < additions_.size(); ++i) {
      additions_[i].covariance = information[i].inverse();
      additions_[i].mean = additions_[i].covariance * weighted[i];
    }
  }

  void estimate_biases() {
    std::vector<std::vector<Vector>> errors(bias_.size());
    std::vector<Vector> all;
    for (std::size_t i = 0; i < draws_.size(); ++i) {
      const Draw& draw = draws_[i];
      const Vector own = errors_[i] - folded(draw, additions_[at(draw.object)].mean);
      all.push_back(alike(at(draw.interval), own));
      errors[at(draw.interval)].push_back(own);
    }
    class_bias_ = located(all, class_bias_);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const Vector of_class = alike(i, class_bias_);
      if (errors[i].empty()) {
        location_[i] = bias_[i] = of_class;
        continue;
      }
      location_[i] = located(errors[i], location_[i]);
      const double known = counts_[i] + config_.bias_prior_draws;
      bias_[i] = (counts_[i] * location_[i] + config_.bias_prior_draws * of_class) / known;
    }
  }

  void estimate_covariances() {
    std::vector<Matrix> sums(bias_.size(), zero_matrix());
    const std::vector<Matrix> inverse = inverse_covariances();
    Matrix total = zero_matrix();
    for (std::size_t i = 0; i < draws_.size(); ++i) {
      const Draw& draw = draws_[i];
      const Addition& addition = additions_[at(draw.object)];
      const Vector rest = rest_of(i) - folded(draw, addition.mean);
      const Matrix onto = said(draw, inverse[at(draw.interval)]);
      const Matrix uncertain = onto * folded(draw, addition.covariance) * onto.transpose() +
                               left_open(draw, inverse[at(draw.interval)]);
      const Matrix square = weights_[i] * (rest * rest.transpose() + uncertain);
      sums[at(draw.interval)] += square;
      total += alike(at(draw.interval), square);
    }
    const auto used = std::count_if(counts_.begin(), counts_.end(), [](int n) { return n > 0; });
    const double freedom = static_cast<double>(draws_.size()) - static_cast<double>(used);
    const Matrix mean = total / std::max(freedom, 1.0);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const double known = std::max(counts_[i] - 1, 0) + config_.prior_draws;
      const Matrix of_class = alike(i, mean);
      covariance_[i] = of_class + least();
      if (known > 0) covariance_[i] = (sums[i] + config_.prior_draws * of_class) / known + least();
    }
  }

  void estimate_common() {
    Matrix sum = zero_matrix();
    for (const Addition& addition : additions_) {
      sum += addition.mean * addition.mean.transpose() + addition.covariance;
    }
    const Matrix common = sum / static_cast<double>(additions_.size()) + least();
    common_ = 0.5 * (common + flipped(parity_, common));  // a class is its own mirror image
  }

  std::span<const Draw> draws_;
  std::vector<Vector> alike_;  // one an interval
  Vector parity_;
  RandomEffectsConfig config_;
  std::vector<double> weights_;          // one a draw
  std::vector<Eigen::VectorXd> errors_;  // the same, filled in
  std::vector<Addition> additions_;
  std::vector<int> counts_;  // draws, one an interval
  Vector class_bias_;
  std::vector<Vector> location_;  // of an interval's errors alone
  std::vector<Vector> bias_;
  std::vector<Matrix> covariance_;
  Matrix common_;
};

}  // namespace

RandomEffects random_effects(std::span<const Draw> draws, std::span<const Eigen::VectorXd> alike,
                             const Eigen::VectorXd& parity, const RandomEffectsConfig& config) {
  Estimation estimation(draws, alike, parity, config);
  for (int i = 0; i < config.iterations; ++i) {
    if (estimation.iterate() < config.tolerance) break;
  }
  return estimation.result();
}

}  // namespace saker::uncertainty
