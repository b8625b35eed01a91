#include "saker/lidar/clouds/float_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "saker/core/error.h"
#include "saker/lidar/file_bytes.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFloats = 10;     // a point
constexpr std::size_t kFewestPoints = 256;  // that tell anything
constexpr std::size_t kMostBytesRead = 8 << 20;
constexpr double kAlike = 0.8;       // of the best share that is explained
constexpr double kExplained = 0.08;  // by the column, at least
constexpr float kFarthest = 2000;    // m

/// What is alike in the numbers of one column: sign, wholeness, size.
constexpr std::size_t kTraits = 4;
std::array<double, kTraits> traits_of(float value) {
  const bool finite = std::isfinite(value);
  return {value < 0 ? 1.0 : 0.0, finite && value == std::floor(value) ? 1.0 : 0.0,
          finite && std::abs(value) <= 1 ? 1.0 : 0.0,
          finite && std::abs(value) > 1e-6F && std::abs(value) < 1e6F ? 0.0 : 1.0};
}

/// Share of the traits' variance that the column explains, 0 … 1.
double explained(std::span<const float> values, std::size_t columns) {
  std::vector<std::array<double, kTraits>> sums(columns, {0, 0, 0, 0});
  const std::size_t rows = values.size() / columns;
  for (std::size_t i = 0; i < rows * columns; ++i) {
    const auto traits = traits_of(values[i]);
    for (std::size_t k = 0; k < kTraits; ++k) sums[i % columns][k] += traits[k];
  }
  double between = 0, total = 0;
  const auto n = static_cast<double>(rows), m = static_cast<double>(columns);
  for (std::size_t k = 0; k < kTraits; ++k) {
    double mean = 0;
    for (const auto& sum : sums) mean += sum[k] / n / m;
    for (const auto& sum : sums) between += (sum[k] / n - mean) * (sum[k] / n - mean) / m;
    total += mean * (1 - mean);
  }
  return total > 0 ? between / total : 0;
}

double range_of(const float* row) { return std::hypot(row[0], row[1], row[2]); }

/// Whether the first three numbers are places of points that a LiDAR may see.
bool plausible(std::span<const float> values, std::size_t columns) {
  const std::size_t rows = values.size() / columns;
  std::vector<double> ranges;
  std::size_t good = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const float* row = &values[i * columns];
    const double range = range_of(row);
    const bool tiny = range > 0 && range < 1e-3;
    good += !std::isfinite(range) || (range < kFarthest && !tiny);
    if (std::isfinite(range) && range > 0) ranges.push_back(range);
  }
  if (ranges.size() < rows / 10 || static_cast<double>(good) < 0.99 * static_cast<double>(rows)) {
    return false;
  }
  std::nth_element(ranges.begin(), ranges.begin() + ranges.size() / 2, ranges.end());
  const double middle = ranges[ranges.size() / 2];
  return middle > 0.3 && middle < 300;
}

struct Column {
  bool whole = true, negative = false, ordered = true, finite = true;
  float least = INFINITY, most = -INFINITY;
  std::set<float> distinct;  // at most a few hundred
};

Column column_of(std::span<const float> values, std::size_t columns, std::size_t which) {
  constexpr std::size_t kMostDistinct = 300;
  Column column;
  float before = -INFINITY;
  std::size_t back = 0, count = 0;
  for (std::size_t i = which; i < values.size(); i += columns, ++count) {
    const float value = values[i];
    if (!std::isfinite(value)) {
      column.finite = false;
      continue;
    }
    column.whole = column.whole && value == std::floor(value);
    column.negative = column.negative || value < 0;
    column.least = std::min(column.least, value);
    column.most = std::max(column.most, value);
    if (column.distinct.size() < kMostDistinct) column.distinct.insert(value);
    back += value < before;
    before = value;
  }
  column.ordered = back * 100 <= count;
  return column;
}

bool is_ring(const Column& c) {
  return c.finite && c.whole && !c.negative && c.most < 260 && c.distinct.size() >= 4;
}

bool is_time(const Column& c) {
  return c.finite && c.ordered && !c.whole && c.distinct.size() > 50 && c.most > c.least;
}

std::vector<float> floats_of(const std::vector<std::uint8_t>& bytes) {
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

/// Numbers of float64 taken as float32 have wild exponents; taken as what they are they have not.
bool is_float64(const std::vector<std::uint8_t>& bytes) {
  std::vector<double> doubles(bytes.size() / sizeof(double));
  std::memcpy(doubles.data(), bytes.data(), doubles.size() * sizeof(double));
  const std::vector<float> values(doubles.begin(), doubles.end());
  std::size_t good = 0;
  for (const double v : doubles) good += std::abs(v) < 1e6 && (v == 0 || std::abs(v) > 1e-9);
  if (static_cast<double>(good) < 0.98 * static_cast<double>(doubles.size())) return false;
  for (std::size_t columns = 3; columns <= kMostFloats; ++columns) {
    if (plausible(values, columns) && explained(values, columns) > kExplained) return true;
  }
  return false;
}

struct Samples {
  std::vector<std::vector<std::uint8_t>> files;
  std::vector<std::size_t> sizes;
};

Samples sample(const std::vector<fs::path>& files) {
  Samples samples;
  const std::size_t last = files.size() - 1;
  for (const std::size_t i : std::set<std::size_t>{0, last / 2, last}) {
    std::error_code error;
    const auto size = fs::file_size(files[i], error);
    if (error || size < kFewestPoints * 4 * sizeof(float)) continue;
    // A whole number of points whatever their size: 2520 floats.
    constexpr std::size_t kPiece = 2520 * sizeof(float);
    const std::size_t most = kMostBytesRead / kPiece * kPiece;
    samples.sizes.push_back(size);
    samples.files.push_back(first_bytes(files[i], std::min<std::size_t>(size, most)));
  }
  return samples;
}

/// Floats a point of one file; 0 where none fits.
std::size_t find_stride(const std::vector<std::uint8_t>& bytes, std::size_t size) {
  const std::vector<float> values = floats_of(bytes);
  std::array<double, kMostFloats + 1> score = {};
  double best = 0;
  for (std::size_t columns = 3; columns <= kMostFloats; ++columns) {
    if (size % (columns * sizeof(float)) != 0 || !plausible(values, columns)) continue;
    score[columns] = explained(values, columns);
    best = std::max(best, score[columns]);
  }
  for (std::size_t columns = 3; columns <= kMostFloats; ++columns) {
    if (score[columns] >= kExplained && score[columns] >= kAlike * best) return columns;
  }
  return 0;
}

/// What most of the files say that say anything; 0 where none does. One of them may be damaged.
std::size_t find_stride(const Samples& samples) {
  std::map<std::size_t, int> votes;
  for (std::size_t i = 0; i < samples.files.size(); ++i) {
    const std::size_t columns = find_stride(samples.files[i], samples.sizes[i]);
    if (columns > 0) ++votes[columns];
  }
  std::size_t chosen = 0;
  for (const auto& [columns, count] : votes) {
    if (chosen == 0 || count > votes[chosen]) chosen = columns;
  }
  return chosen;
}

}  // namespace

FloatFields name_columns(std::span<const float> values, std::size_t columns) {
  FloatFields fields = {"x", "y", "z"};
  for (std::size_t i = 3; i < columns; ++i) fields.emplace_back("_");
  const auto free = [&](const char* name) {
    return std::find(fields.begin(), fields.end(), name) == fields.end();
  };
  for (std::size_t i = 3; i < columns; ++i) {
    const Column column = column_of(values, columns, i);
    if (i == 3 && column.finite && !column.negative) {
      fields[i] = "intensity";
    } else if (is_ring(column) && free("ring")) {
      fields[i] = "ring";
    } else if (is_time(column) && free("time")) {
      fields[i] = "time";
    }
  }
  return fields;
}

FloatFields parse_point_fields(const std::string& text) {
  static const std::map<std::string, std::string> known = {{"x", "x"},
                                                           {"y", "y"},
                                                           {"z", "z"},
                                                           {"i", "intensity"},
                                                           {"intensity", "intensity"},
                                                           {"reflectivity", "intensity"},
                                                           {"ring", "ring"},
                                                           {"r", "ring"},
                                                           {"t", "time"},
                                                           {"time", "time"},
                                                           {"_", "_"}};
  FloatFields fields;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const auto name = known.find(text.substr(at, end - at));
    const bool twice = name != known.end() && name->second != "_" &&
                       std::find(fields.begin(), fields.end(), name->second) != fields.end();
    if (name == known.end() || twice) {
      throw Error("--point-fields " + text + ": \"" + text.substr(at, end - at) +
                  "\", expected x, y, z, i, ring, t, each once, or _ for what is not used");
    }
    fields.push_back(name->second);
    at = end + 1;
  }
  for (const char* axis : {"x", "y", "z"}) {
    if (std::find(fields.begin(), fields.end(), axis) == fields.end()) {
      throw Error("--point-fields " + text + ": no " + axis + ", expected x, y and z");
    }
  }
  return fields;
}

std::string describe_fields(const FloatFields& fields) {
  std::string text;
  for (const std::string& field : fields) text += (text.empty() ? "" : " ") + field;
  return text;
}

FloatFields find_fields(const std::vector<fs::path>& files, const std::string& where) {
  const FloatFields kitti = {"x", "y", "z", "intensity"};
  if (files.empty()) return kitti;
  const Samples samples = sample(files);
  if (samples.files.empty()) return kitti;
  const std::size_t columns = find_stride(samples);
  if (columns > 0) return name_columns(floats_of(samples.files.front()), columns);
  for (const auto& bytes : samples.files) {
    if (is_float64(bytes)) {
      throw Error(where + ": numbers of float64, expected float32 (convert the files)");
    }
  }
  throw Error(
      where + ": " + std::to_string(samples.sizes.front()) +
      " bytes a scan in which no number of floats a point makes a scan, expected float32 x, "
      "y, z and what else there is (--point-fields x,y,z,i,ring says it)");
}

}  // namespace saker::lidar
