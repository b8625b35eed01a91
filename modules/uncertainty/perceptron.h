#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/rng.h"

namespace saker::uncertainty {

struct PerceptronConfig {
  int hidden_layers = 2;
  int hidden_units = 16;
  int epochs = 60;
  int batch = 64;
  double learning_rate = 0.01;
  double weight_decay = 1e-4;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("hidden_layers", hidden_layers, {1, 4}, "", "between the inputs and the output");
    v.field("hidden_units", hidden_units, {1, 128}, "",
            "of each: enough for a surface over two inputs");
    v.field("epochs", epochs, {1, 10000}, "",
            "passes over the samples; the step falls to zero over them");
    v.field("batch", batch, {1, 4096}, "samples", "of one step");
    v.field("learning_rate", learning_rate, {1e-6, 1}, "", "first step size of Adam");
    v.field("weight_decay", weight_decay, {0, 1}, "",
            "pull of the weights to zero, so that rare views are not fitted to the last sample");
  }
};

/// A multilayer perceptron with one output in (0, 1): tanh inside, a sigmoid at the end.
class Perceptron {
 public:
  struct Layer {
    Eigen::MatrixXd weights;  ///< outputs × inputs
    Eigen::VectorXd offsets;
  };

  Perceptron() = default;
  /// Requires that each layer takes what the one before gives, and that the last gives one value.
  explicit Perceptron(std::vector<Layer> layers) : layers_(std::move(layers)) {}

  [[nodiscard]] bool empty() const { return layers_.empty(); }
  [[nodiscard]] double operator()(const Eigen::VectorXd& input) const;
  [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }

 private:
  std::vector<Layer> layers_;
};

/// Trained on the cross-entropy with targets in [0, 1] by Adam (Kingma and Ba, ICLR 2015) with
/// decoupled weight decay; a function of its arguments only.
/// \param inputs  one column a sample, each row of about unit spread
[[nodiscard]] Perceptron trained(const PerceptronConfig& config, const Eigen::MatrixXd& inputs,
                                 const Eigen::VectorXd& targets, core::Rng rng);

}  // namespace saker::uncertainty
