#pragma once

#include <string>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/uncertainty/covariate.h"

/// A model file's keys, as plain values (core/config.h): matrices are lists of their rows in order.
namespace saker::uncertainty {

struct TrialDocument {
  std::string what;
  double gain = NAN, standard_error = NAN;
  bool kept = false;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("what", what, "", "input that was tried");
    v.field("gain", gain, "", "a held-out recording: log-likelihood, or squared error less");
    v.field("standard_error", standard_error, "", "of the gain");
    v.field("kept", kept, "", "the gain was beyond chance");
  }
};

struct InputDocument {
  Covariate covariate = Covariate::elevation;
  double mean = NAN, spread = NAN;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("covariate", covariate, "", "further input of the perceptron");
    v.field("mean", mean, "rad or the sensor's", "of the samples");
    v.field("spread", spread, "rad or the sensor's", "standard deviation of the samples");
  }
};

struct LayerDocument {
  int inputs = 0;
  std::vector<double> weights, offsets;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("inputs", inputs, {1, 1000}, "", "values that the layer takes");
    v.field("weights", weights, "", "outputs x inputs");
    v.field("offsets", offsets, "", "one an output");
  }
};

struct ConfidenceDocument {
  double mean = NAN;
  std::vector<InputDocument> inputs;
  std::vector<LayerDocument> layers;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("mean", mean, {0, 1}, "", "over all samples: what holds where there are no layers");
    v.list("inputs", inputs, "beside range / 10 m - 1, sine and cosine of the folded angle");
    v.list("layers", layers, "of the perceptron: tanh between them, a sigmoid at the end");
  }
};

struct SlopeDocument {
  Covariate covariate = Covariate::elevation;
  double spread = NAN;
  std::vector<double> bias;
  double log_scale = NAN;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("covariate", covariate, "", "further input of bias and covariance");
    v.field("spread", spread, "rad or the sensor's", "standard deviation within an interval");
    v.field("bias", bias, "m", "by which the bias moves with a standard deviation");
    v.field("log_scale", log_scale, "", "by which the covariance's logarithm moves with it");
  }
};

struct IntervalDocument {
  int objects = 0;
  double whole = 1;
  std::vector<double> bias, covariance, covariate_mean;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("objects", objects, {0, 1e9}, "",
            "seen from here, each side for itself; 0: not flown, the nearest interval's values");
    v.field("whole", whole, {0, 1}, "", "share of measurements that show the object end to end");
    v.field("bias", bias, "m", "measured - true, of those");
    v.field("covariance", covariance, "m^2", "of the mean of one object's measurements from here");
    v.field("covariate_mean", covariate_mean, "rad or the sensor's", "one a slope");
  }
};

struct ErrorsDocument {
  std::vector<double> range_edges;
  int sectors = 0;
  double whole_length_sd = 0;
  std::vector<double> common;
  std::vector<SlopeDocument> slopes;
  std::vector<IntervalDocument> intervals;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("range_edges", range_edges, {0, 1000}, "m", "of the intervals");
    v.field("sectors", sectors, {1, 360}, "", "of the folded angle from front to back");
    v.field("whole_length_sd", whole_length_sd, {0, 1000}, "m",
            "that a cuboid's measurement states of its length where it shows it end to end");
    v.field("common", common, "m^2", "covariance of what all measurements of one object share");
    v.list("slopes", slopes, "of further inputs");
    v.list("intervals", intervals, "the sectors of the nearest range, then of the next");
  }
};

struct ClassDocument {
  std::string name;
  objects::Shape shape = objects::Shape::none;
  int recordings = 0, objects = 0, samples = 0;
  std::vector<TrialDocument> trials;
  ConfidenceDocument confidence;
  ErrorsDocument errors;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("name", name, "", "as in the class table");
    v.field("shape", shape, "",
            "errors of cuboids: x, y, length, width; of cylinders: x, y along the line of sight");
    v.field("recordings", recordings, {0, 1e9}, "", "that it was fitted to");
    v.field("objects", objects, {0, 1e9}, "", "that it was fitted to");
    v.field("samples", samples, {0, 1e9}, "", "that it was fitted to");
    v.list("trials", trials, "of inputs, on recordings that the fit had not seen");
    v.group("confidence", confidence, "probability of the class over the points in the model");
    v.group("errors", errors, "bias and covariance of the measured model");
  }
};

struct ProvenanceDocument {
  std::string data, sensor, commit, seed;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("data", data, "", "what was flown");
    v.field("sensor", sensor, "", "and its mode");
    v.field("commit", commit, "", "of the program that flew");
    v.field("seed", seed, "", "of the fit");
  }
};

struct ModelDocument {
  int format = 0;
  ProvenanceDocument provenance;
  std::vector<ClassDocument> classes;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("format", format, "", "version of this file's form");
    v.group("provenance", provenance, "where the model comes from");
    v.list("classes", classes, "by ascending place in the class table");
  }
};

}  // namespace saker::uncertainty
