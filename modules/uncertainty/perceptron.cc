#include "saker/uncertainty/perceptron.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace saker::uncertainty {
namespace {

using Layer = Perceptron::Layer;

double sigmoid(double x) { return 1 / (1 + std::exp(-x)); }

/// Glorot and Bengio's uniform start.
std::vector<Layer> first_layers(const PerceptronConfig& config, Eigen::Index inputs,
                                core::Rng& rng) {
  std::vector<Layer> layers;
  Eigen::Index from = inputs;
  for (int i = 0; i <= config.hidden_layers; ++i) {
    const Eigen::Index to = i < config.hidden_layers ? config.hidden_units : 1;
    const double limit = std::sqrt(6.0 / static_cast<double>(from + to));
    Layer layer{Eigen::MatrixXd(to, from), Eigen::VectorXd::Zero(to)};
    for (double& weight : layer.weights.reshaped()) weight = rng.uniform(-limit, limit);
    layers.push_back(std::move(layer));
    from = to;
  }
  return layers;
}

/// Adam's running moments of one array of parameters.
struct Moments {
  Eigen::ArrayXXd first, second;

  explicit Moments(const Eigen::MatrixXd& like)
      : first(Eigen::ArrayXXd::Zero(like.rows(), like.cols())), second(first) {}

  Eigen::ArrayXXd step(const Eigen::MatrixXd& gradient, int t) {
    constexpr double kFirst = 0.9, kSecond = 0.999, kTiny = 1e-8;  // the paper's
    first = kFirst * first + (1 - kFirst) * gradient.array();
    second = kSecond * second + (1 - kSecond) * gradient.array().square();
    const Eigen::ArrayXXd mean = first / (1 - std::pow(kFirst, t));
    const Eigen::ArrayXXd square = second / (1 - std::pow(kSecond, t));
    return mean / (square.sqrt() + kTiny);
  }
};

class Training {
 public:
  Training(const PerceptronConfig& config, Eigen::Index inputs, core::Rng& rng)
      : config_(config), layers_(first_layers(config, inputs, rng)) {
    for (const Layer& layer : layers_) {
      moments_.emplace_back(Moments(layer.weights), Moments(layer.offsets));
    }
  }

  /// One step on one batch; `rate` is Adam's step size.
  void step(const Eigen::MatrixXd& inputs, const Eigen::RowVectorXd& targets, double rate) {
    const std::vector<Eigen::MatrixXd> outputs = forward(inputs);
    ++steps_;
    // Of the cross-entropy by what goes into the sigmoid.
    Eigen::MatrixXd gradient = (outputs.back() - targets) / static_cast<double>(targets.size());
    for (std::size_t i = layers_.size(); i-- > 0;) {
      const Eigen::MatrixXd& before = i == 0 ? inputs : outputs[i - 1];
      Eigen::MatrixXd passed_on;
      if (i > 0) {
        const Eigen::ArrayXXd slope = 1 - before.array().square();
        passed_on = (layers_[i].weights.transpose() * gradient).array() * slope;
      }
      update(i, gradient * before.transpose(), gradient.rowwise().sum(), rate);
      gradient = std::move(passed_on);
    }
  }

  [[nodiscard]] std::vector<Layer> layers() && { return std::move(layers_); }

 private:
  [[nodiscard]] std::vector<Eigen::MatrixXd> forward(const Eigen::MatrixXd& inputs) const {
    std::vector<Eigen::MatrixXd> outputs;
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      const Eigen::MatrixXd& before = i == 0 ? inputs : outputs[i - 1];
      Eigen::MatrixXd sums = (layers_[i].weights * before).colwise() + layers_[i].offsets;
      const bool last = i + 1 == layers_.size();
      outputs.emplace_back(last ? Eigen::MatrixXd(sums.unaryExpr(&sigmoid))
                                : Eigen::MatrixXd(sums.array().tanh()));
    }
    return outputs;
  }

  void update(std::size_t i, const Eigen::MatrixXd& weights, const Eigen::MatrixXd& offsets,
              double rate) {
    Layer& layer = layers_[i];
    layer.weights *= 1 - rate * config_.weight_decay;
    layer.weights.array() -= rate * moments_[i].first.step(weights, steps_);
    layer.offsets.array() -= rate * moments_[i].second.step(offsets, steps_).col(0);
  }

  PerceptronConfig config_;
  std::vector<Layer> layers_;
  std::vector<std::pair<Moments, Moments>> moments_;  // of weights, of offsets
  int steps_ = 0;
};

std::vector<Eigen::Index> shuffled(Eigen::Index count, core::Rng& rng) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<std::size_t>(rng.index(static_cast<int>(i)))]);
  }
  return order;
}

}  // namespace

double Perceptron::operator()(const Eigen::VectorXd& input) const {
  Eigen::VectorXd values = input;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const Eigen::VectorXd sums = layers_[i].weights * values + layers_[i].offsets;
    if (i + 1 == layers_.size()) return sigmoid(sums[0]);
    values = sums.array().tanh();
  }
  return NAN;
}

Perceptron trained(const PerceptronConfig& config, const Eigen::MatrixXd& inputs,
                   const Eigen::VectorXd& targets, core::Rng rng) {
  Training training(config, inputs.rows(), rng);
  for (int epoch = 0; epoch < config.epochs; ++epoch) {
    const double left = 1 - static_cast<double>(epoch) / config.epochs;
    const std::vector<Eigen::Index> order = shuffled(inputs.cols(), rng);
    for (std::size_t begin = 0; begin < order.size();
         begin += static_cast<std::size_t>(config.batch)) {
      const std::size_t end =
          std::min(order.size(), begin + static_cast<std::size_t>(config.batch));
      const std::vector<Eigen::Index> batch(order.begin() + static_cast<std::ptrdiff_t>(begin),
                                            order.begin() + static_cast<std::ptrdiff_t>(end));
      training.step(inputs(Eigen::all, batch), targets(batch).transpose(),
                    config.learning_rate * left);
    }
  }
  return Perceptron(std::move(training).layers());
}

}  // namespace saker::uncertainty
