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
    additions_.assign(at(objects), {zero_vector(), zero_matrix()});
    counts_.assign(alike.size(), 0);
    for (const Draw& draw : draws) ++counts_[at(draw.interval)];
    start(alike.size());
  }

  /// \return how much the common covariance changed, relative to itself
  double iterate() {
    const Matrix before = common_;
    weigh();
    estimate_additions();
    estimate_biases();
    estimate_covariances();
    estimate_common();
    return (common_ - before).norm() / before.norm();
  }

  [[nodiscard]] RandomEffects result() const {
    RandomEffects result;
    result.draws = counts_;
    result.common = common_;
    for (std::size_t i = 0; i < bias_.size(); ++i) {
      result.bias.emplace_back(bias_[i]);
      const double known = counts_[i] + config_.bias_prior_draws;
      const bool bias_is_known = config_.about_truth || !(known > 0);
      result.covariance.emplace_back(covariance_[i] * (bias_is_known ? 1 : 1 + 1 / known));
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
    return Vector(draws_[i].error) - bias_[at(draws_[i].interval)];
  }

  /// All intervals alike, half of the variance common.
  void start(std::size_t intervals) {
    const double share = 1 / static_cast<double>(draws_.size());
    Vector mean = zero_vector();
    if (!config_.about_truth) {
      for (const Draw& draw : draws_) mean += share * draw.error;
    }
    Matrix covariance = least();
    for (const Draw& draw : draws_) {
      const Vector rest = draw.error - mean;
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
      const Vector rest = rest_of(i);
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
      const Matrix own = folded(draw, Matrix(weights_[i] * known[at(draw.interval)]));
      information[at(draw.object)] += own;
      weighted[at(draw.object)] += own * folded(draw, rest_of(i));
    }
    for (std::size_t i = 0; i < additions_.size(); ++i) {
      additions_[i].covariance = information[i].inverse();
      additions_[i].mean = additions_[i].covariance * weighted[i];
    }
  }

  void estimate_biases() {
    if (config_.about_truth) return;  // they stay 0
    std::vector<std::vector<Vector>> errors(bias_.size());
    std::vector<Vector> all;
    for (std::size_t i = 0; i < draws_.size(); ++i) {
      const Draw& draw = draws_[i];
      const Vector own = draw.error - folded(draw, additions_[at(draw.object)].mean);
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
    Matrix total = zero_matrix();
    for (std::size_t i = 0; i < draws_.size(); ++i) {
      const Draw& draw = draws_[i];
      const Addition& addition = additions_[at(draw.object)];
      const Vector rest = rest_of(i) - folded(draw, addition.mean);
      const Matrix uncertain = folded(draw, addition.covariance);
      const Matrix square = weights_[i] * (rest * rest.transpose() + uncertain);
      sums[at(draw.interval)] += square;
      total += alike(at(draw.interval), square);
    }
    const auto used = std::count_if(counts_.begin(), counts_.end(), [](int n) { return n > 0; });
    const double freedom =
        static_cast<double>(draws_.size()) - (config_.about_truth ? 0 : static_cast<double>(used));
    const Matrix mean = total / std::max(freedom, 1.0);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const int free = config_.about_truth ? counts_[i] : std::max(counts_[i] - 1, 0);
      const double known = free + config_.prior_draws;
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
  std::vector<double> weights_;  // one a draw
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
