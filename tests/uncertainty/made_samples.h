#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "saker/core/rng.h"
#include "saker/uncertainty/sample.h"

/// Samples of vehicles whose errors follow a known law.
namespace saker::uncertainty {

struct MadeLaw {
  bool covariates = false;  ///< elevation moves the length's bias, reflectivity does nothing
  double common_sd = 0.06;  ///< of length, in all measurements of one object; 0.02 of the others
  double window_sd = 0.01;  ///< between windows of one cell

  /// As seen from the object's own frame.
  [[nodiscard]] Eigen::Vector4d bias(const View& view) const {
    const double along = std::cos(view.angle), left = std::sin(view.angle);
    return {0.05 * along, 0.08 * left, -0.1 * std::abs(along), 0.02};
  }
  [[nodiscard]] Eigen::Matrix4d covariance(const View& view) const {
    const double sd = 0.02 + 0.004 * view.range;
    Eigen::Vector4d sds(sd, 0.7 * sd, 2 * sd, sd);
    Eigen::Matrix4d covariance = sds.cwiseAbs2().asDiagonal();
    // A rear end that is not seen is wrong in place and length together.
    covariance(0, 2) = covariance(2, 0) = 0.5 * sds[0] * sds[2] * std::cos(view.angle);
    return covariance;
  }
  [[nodiscard]] Eigen::Matrix4d common() const {
    Eigen::Vector4d variances = Eigen::Vector4d::Constant(0.02 * 0.02);
    variances[2] = common_sd * common_sd;
    return variances.asDiagonal();
  }
  [[nodiscard]] double confidence(const View& view) const {
    const double side = std::abs(std::sin(view.angle));
    return 1 / (1 + std::exp(-(2.5 + 1.5 * side - 0.15 * view.range)));
  }
};

inline Eigen::Vector4d normal4(core::Rng& rng, const Eigen::Matrix4d& covariance) {
  Eigen::Vector4d z;
  for (double& value : z) value = rng.normal();
  return covariance.llt().matrixL() * z;
}

/// Each object from every range of the edges and every 30 degrees, several windows each.
inline std::vector<Sample> made_samples(const MadeLaw& law, const std::vector<double>& edges,
                                        int objects, std::uint64_t seed, int windows = 1) {
  std::vector<Sample> samples;
  core::Rng rng(seed);
  for (int object = 0; object < objects; ++object) {
    const Eigen::Vector4d addition = normal4(rng, law.common());
    for (std::size_t range = 0; range + 1 < edges.size(); ++range) {
      for (int sector = -6; sector < 6; ++sector) {
        Sample sample;
        sample.recording = "made_" + std::to_string(seed) + "_" + std::to_string(object);
        sample.object_id = 0;
        sample.kind = "sedan";
        sample.class_id = 1;
        sample.view.range = 0.5 * (edges[range] + edges[range + 1]);
        sample.view.angle = (sector + 0.5) * std::numbers::pi / 6;
        sample.view.elevation = rng.uniform(0, 0.6);
        sample.view.reflectivity = rng.uniform(10, 100);
        const Eigen::Vector4d rest = normal4(rng, law.covariance(sample.view));
        for (int window = 0; window < windows; ++window) {
          sample.confidence =
              std::clamp(law.confidence(sample.view) + rng.normal(0, 0.02), 0.0, 1.0);
          Eigen::Vector4d error = law.bias(sample.view) + addition + rest;
          for (double& value : error) value += rng.normal(0, law.window_sd);
          if (law.covariates) error[2] += 0.3 * (sample.view.elevation - 0.3);
          sample.error = error;
          samples.push_back(sample);
        }
      }
    }
  }
  return samples;
}

}  // namespace saker::uncertainty
