#include "saker/uncertainty/model_file.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/core/sha256.h"
#include "saker/uncertainty/model_document.h"

namespace saker::uncertainty {
namespace {

constexpr int kFormat = 2;
constexpr std::string_view kOpening =
    "# What a measurement is worth by where the object is seen from, fitted to flights by\n"
    "# `saker characterise fit`. The checksum is of all that follows its line: any change is "
    "refused.\n"
    "sha256: ";

std::vector<double> list_of(const Eigen::MatrixXd& matrix) {
  std::vector<double> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) rows.push_back(matrix(i, j));
  }
  return rows;
}

// To the document.

ConfidenceDocument document_of(const SemanticModel& model) {
  ConfidenceDocument document{model.mean, {}, {}};
  for (const auto& input : model.inputs) {
    document.inputs.push_back({input.covariate, input.mean, input.spread});
  }
  for (const auto& layer : model.perceptron.layers()) {
    document.layers.push_back(
        {static_cast<int>(layer.weights.cols()), list_of(layer.weights), list_of(layer.offsets)});
  }
  return document;
}

ErrorsDocument document_of(const GeometricModel& model) {
  const GeometricModel::Parts& parts = model.parts();
  ErrorsDocument document{parts.intervals.range_edges,
                          parts.intervals.sectors,
                          parts.whole_length_sd_m,
                          list_of(parts.common),
                          {},
                          {}};
  for (const auto& slope : parts.slopes) {
    document.slopes.push_back(
        {slope.covariate, slope.spread, list_of(slope.bias), slope.log_scale});
  }
  for (const auto& interval : parts.fitted) {
    document.intervals.push_back({interval.objects, interval.whole, list_of(interval.bias),
                                  list_of(interval.covariance), list_of(interval.covariate_mean)});
  }
  return document;
}

ClassDocument document_of(const ClassModel& model, const objects::ClassTable& table) {
  ClassDocument document;
  document.name = table[model.id].name;
  document.shape = table[model.id].shape;
  document.recordings = model.recordings;
  document.objects = model.objects;
  document.samples = model.samples;
  for (const Trial& trial : model.trials) {
    document.trials.push_back({trial.what, trial.gain, trial.standard_error, trial.kept});
  }
  document.confidence = document_of(model.semantic);
  document.errors = document_of(model.geometric);
  return document;
}

// From the document.

/// The place of what is read, for messages.
class Place {
 public:
  explicit Place(std::string where) : where_(std::move(where)) {}

  [[nodiscard]] Place in(const std::string& key) const { return Place(where_ + key); }
  void expect(bool holds, const std::string& what) const {
    if (!holds) throw Error(fmt::format("{}: expected {}", where_, what));
  }

  /// rows × columns finite numbers.
  [[nodiscard]] Eigen::MatrixXd matrix(const std::vector<double>& values, Eigen::Index rows,
                                       Eigen::Index columns) const {
    expect(static_cast<Eigen::Index>(values.size()) == rows * columns,
           fmt::format("{} numbers, found {}", rows * columns, values.size()));
    Eigen::MatrixXd matrix(rows, columns);
    for (Eigen::Index i = 0; i < matrix.size(); ++i) {
      matrix(i / columns, i % columns) = values[static_cast<std::size_t>(i)];
    }
    expect(matrix.allFinite(), "finite numbers");
    return matrix;
  }

  [[nodiscard]] Eigen::MatrixXd covariance(const std::vector<double>& values,
                                           Eigen::Index n) const {
    Eigen::MatrixXd covariance = matrix(values, n, n);
    expect(covariance.isApprox(covariance.transpose(), 1e-9) &&
               covariance.llt().info() == Eigen::Success,
           "a positive definite covariance");
    return covariance;
  }

  [[nodiscard]] double number(double value, bool positive = false) const {
    expect(std::isfinite(value) && (!positive || value > 0),
           positive ? "a number above 0" : "a finite number");
    return value;
  }

 private:
  std::string where_;
};

SemanticModel semantic_of(const ConfidenceDocument& document, const Place& place) {
  SemanticModel model;
  model.mean = place.in(".mean").number(document.mean);
  for (const InputDocument& input : document.inputs) {
    const Place inside = place.in(".inputs");
    model.inputs.push_back(
        {input.covariate, inside.number(input.mean), inside.number(input.spread, true)});
  }
  std::vector<Perceptron::Layer> layers;
  std::size_t inputs = 3 + model.inputs.size();
  for (std::size_t i = 0; i < document.layers.size(); ++i) {
    const LayerDocument& layer = document.layers[i];
    const Place inside = place.in(fmt::format(".layers[{}]", i));
    const std::size_t outputs = i + 1 < document.layers.size() ? layer.offsets.size() : 1;
    inside.expect(layer.inputs == static_cast<int>(inputs), fmt::format("{} inputs", inputs));
    const auto rows = static_cast<Eigen::Index>(outputs);
    layers.push_back({inside.matrix(layer.weights, rows, static_cast<Eigen::Index>(inputs)),
                      inside.matrix(layer.offsets, rows, 1)});
    inputs = outputs;
  }
  model.perceptron = Perceptron(std::move(layers));
  return model;
}

Intervals intervals_of(const ErrorsDocument& document, bool cuboid, const Place& place) {
  const auto& edges = document.range_edges;
  bool ascending = edges.size() >= 2;
  for (std::size_t i = 1; i < edges.size(); ++i) ascending = ascending && edges[i] > edges[i - 1];
  place.in(".range_edges").expect(ascending, "at least two ascending ranges");
  place.in(".sectors")
      .expect(cuboid == (document.sectors > 1),
              cuboid ? "at least two for a cuboid" : "1 for a cylinder");
  return {edges, document.sectors};
}

GeometricModel geometric_of(const ErrorsDocument& document, bool cuboid, const Place& place) {
  const Eigen::Index n = cuboid ? 4 : 2;
  GeometricModel::Parts parts;
  parts.intervals = intervals_of(document, cuboid, place);
  parts.whole_length_sd_m = place.in(".whole_length_sd").number(document.whole_length_sd, cuboid);
  parts.common = place.in(".common").covariance(document.common, n);
  for (const SlopeDocument& slope : document.slopes) {
    const Place inside = place.in(".slopes");
    parts.slopes.push_back({slope.covariate, inside.number(slope.spread, true),
                            inside.matrix(slope.bias, n, 1), inside.number(slope.log_scale)});
  }
  place.in(".intervals")
      .expect(
          static_cast<int>(document.intervals.size()) == parts.intervals.size(),
          fmt::format("{} entries, found {}", parts.intervals.size(), document.intervals.size()));
  const auto slopes = static_cast<Eigen::Index>(parts.slopes.size());
  for (std::size_t i = 0; i < document.intervals.size(); ++i) {
    const IntervalDocument& interval = document.intervals[i];
    const Place inside = place.in(fmt::format(".intervals[{}]", i));
    parts.fitted.push_back({inside.in(".bias").matrix(interval.bias, n, 1),
                            inside.in(".covariance").covariance(interval.covariance, n),
                            inside.in(".covariate_mean").matrix(interval.covariate_mean, slopes, 1),
                            inside.in(".whole").number(interval.whole), interval.objects});
  }
  return GeometricModel(std::move(parts));
}

ClassModel class_of(const ClassDocument& document, const objects::ClassTable& table,
                    const std::string& source) {
  const Place place(fmt::format("{}: class {}", source, document.name));
  std::optional<objects::ClassId> id;
  for (int i = 0; i < table.size(); ++i) {
    const auto candidate = static_cast<objects::ClassId>(i);
    if (table[candidate].name == document.name) id = candidate;
  }
  place.expect(id.has_value(), "a class of the class table");
  const bool cuboid = document.shape == objects::Shape::cuboid;
  place.in(".shape").expect(cuboid || document.shape == objects::Shape::cylinder,
                            "cuboid or cylinder");
  place.in(".shape").expect(table[*id].shape == document.shape, "that of the class table");
  ClassModel model;
  model.id = *id;
  model.semantic = semantic_of(document.confidence, place.in(".confidence"));
  model.geometric = geometric_of(document.errors, cuboid, place.in(".errors"));
  for (const TrialDocument& trial : document.trials) {
    model.trials.push_back({trial.what, trial.gain, trial.standard_error, trial.kept});
  }
  model.recordings = document.recordings;
  model.objects = document.objects;
  model.samples = document.samples;
  return model;
}

/// What follows the line of the checksum, which it must have.
std::string unsealed(const std::string& text, const std::string& source) {
  const std::size_t line = text.rfind("sha256: ", 0) == 0 ? 0 : text.find("\nsha256: ") + 1;
  const std::size_t end = text.find('\n', line);
  if (text.compare(line, 8, "sha256: ") != 0 || end == std::string::npos) {
    throw Error(fmt::format("{}: no model file: expected a line \"sha256: ...\"", source));
  }
  const std::string said = text.substr(line + 8, end - line - 8);
  std::string body = text.substr(end + 1);
  const std::string found = core::sha256(body);
  if (said == found) return body;
  throw Error(fmt::format("{}: cut or edited: its content has sha256 {}, expected {}", source,
                          found.substr(0, 12), said.substr(0, 12)));
}

void check_format(const std::string& body, const std::string& source) {
  const YAML::Node root = core::parse_yaml(body, source);
  const bool has = root.IsMap() && root["format"] && root["format"].IsScalar();
  const std::string format = has ? root["format"].Scalar() : "none";
  if (format == std::to_string(kFormat)) return;
  throw Error(
      fmt::format("{}: format {}, expected {}: fit the model again", source, format, kFormat));
}

std::uint64_t seed_of(const std::string& text, const std::string& source) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  Place(source + ": provenance.seed")
      .expect(error == std::errc() && end == text.data() + text.size(), "a whole number");
  return seed;
}

}  // namespace

std::string sealed(std::string_view body) {
  return fmt::format("{}{}\n{}", kOpening, core::sha256(body), body);
}

std::string model_text(const Model& model, const objects::ClassTable& table) {
  const Provenance& from = model.provenance();
  ModelDocument document{
      kFormat, {from.data, from.sensor, from.commit, std::to_string(from.seed)}, {}};
  for (const auto& [id, own] : model.classes()) document.classes.push_back(document_of(own, table));
  return sealed(core::config_to_yaml(document));
}

Model model_from_text(const std::string& text, const std::string& source,
                      const objects::ClassTable& table) {
  const std::string body = unsealed(text, source);
  check_format(body, source);
  const auto document = core::config_from_yaml<ModelDocument>(body, source);
  const ProvenanceDocument& from = document.provenance;
  Place(source).expect(!document.classes.empty(), "at least one class");
  std::vector<ClassModel> classes;
  for (const ClassDocument& own : document.classes) {
    classes.push_back(class_of(own, table, source));
    for (std::size_t i = 0; i + 1 < classes.size(); ++i) {
      Place(source + ": class " + own.name)
          .expect(classes[i].id != classes.back().id, "each class once");
    }
  }
  return Model(classes, {from.data, from.sensor, from.commit, seed_of(from.seed, source)});
}

}  // namespace saker::uncertainty
