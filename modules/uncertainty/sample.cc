#include "saker/uncertainty/sample.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/stated_length.h"

namespace saker::uncertainty {
namespace {

const std::string kHeader =
    "recording,object_id,kind,class,time_s,range,angle,elevation,reflectivity,points,confidence,"
    "error_x,error_y,error_length,error_width,length_sd,width_sd";
constexpr std::size_t kFirstError = 11, kLengthSd = 15, kWidthSd = 16;

Eigen::Vector2d in_frame(double heading, const Eigen::Vector2d& v) {
  return Eigen::Rotation2Dd(-heading) * v;
}

/// Length and width as seen from the true cuboid's frame: swapped where the measured x axis lies
/// nearer to the true y axis.
Eigen::Vector2d edges_along(const objects::Cuboid& measured, double true_heading) {
  const double turn = core::yaw(measured.pose.linear()) - true_heading;
  const bool across = std::abs(std::sin(turn)) > std::abs(std::cos(turn));
  return across ? Eigen::Vector2d(measured.size.y(), measured.size.x())
                : Eigen::Vector2d(measured.size.head<2>());
}

Eigen::Vector4d error_of(const objects::Cuboid& measured, const objects::Cuboid& truth) {
  const double heading = core::yaw(truth.pose.linear());
  const Eigen::Vector2d offset = (measured.pose.translation() - truth.pose.translation()).head<2>();
  Eigen::Vector4d error;
  error << in_frame(heading, offset), edges_along(measured, heading) - truth.size.head<2>();
  return error;
}

Eigen::Vector2d error_of(const objects::Cylinder& measured, const objects::Cylinder& truth,
                         const Eigen::Vector3d& eye) {
  const Eigen::Vector2d sight = (truth.root - eye).head<2>();
  return in_frame(std::atan2(sight.y(), sight.x()), (measured.root - truth.root).head<2>());
}

bool fits_in_csv(const std::string& name) {
  return name.find_first_of(",\"\r\n") == std::string::npos;
}

std::string line_of(const Sample& sample, const objects::ClassTable& table) {
  for (const std::string& name : {sample.recording, sample.kind}) {
    if (!fits_in_csv(name)) {
      throw Error(fmt::format("samples: name \"{}\" holds a comma, quote or line end", name));
    }
  }
  std::string line = fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{}", sample.recording, sample.object_id, sample.kind,
      table[sample.class_id].name, sample.time_s, sample.view.range, sample.view.angle,
      sample.view.elevation, sample.view.reflectivity, sample.points, sample.confidence);
  for (int i = 0; i < 4; ++i) {
    line += i < sample.error.size() ? fmt::format(",{}", sample.error[i]) : ",";
  }
  return line + fmt::format(",{},{}\n", sample.length_sd, sample.width_sd);
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// One line of the file: reads its fields, refuses with file and line.
class Line {
 public:
  Line(const std::filesystem::path& file, std::size_t number, const std::string& text)
      : where_(fmt::format("{}:{}", file.string(), number)), fields_(split(text, ',')) {
    const std::size_t expected = split(kHeader, ',').size();
    if (fields_.size() != expected) {
      throw Error(fmt::format("{}: {} fields, expected {}", where_, fields_.size(), expected));
    }
  }

  [[nodiscard]] Sample sample(const objects::ClassTable& table) const {
    Sample sample;
    sample.recording = fields_[0];
    sample.object_id = number<int>(1);
    sample.kind = fields_[2];
    sample.class_id = class_of(table);
    sample.time_s = number<double>(4);
    sample.view = {within(5, 0, 1e4), within(6, -4, 4), number<double>(7), number<double>(8)};
    sample.points = number<int>(9);
    sample.confidence = within(10, 0, 1);
    sample.error.resize(table[sample.class_id].shape == objects::Shape::cuboid ? 4 : 2);
    for (int i = 0; i < sample.error.size(); ++i) {
      sample.error[i] = within(kFirstError + static_cast<std::size_t>(i), -1e3, 1e3);
    }
    sample.length_sd = number<double>(kLengthSd);
    sample.width_sd = number<double>(kWidthSd);
    return sample;
  }

 private:
  [[noreturn]] void fail(std::size_t field, const std::string& expected) const {
    throw Error(fmt::format("{}: {} \"{}\", expected {}", where_, split(kHeader, ',')[field],
                            fields_[field], expected));
  }

  template <class T>
  [[nodiscard]] T number(std::size_t field) const {
    T value{};
    const std::string& text = fields_[field];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text.empty()) {
      fail(field, "a number");
    }
    return value;
  }

  [[nodiscard]] double within(std::size_t field, double low, double high) const {
    const double value = number<double>(field);
    if (!(value >= low && value <= high)) fail(field, fmt::format("{:g} ... {:g}", low, high));
    return value;
  }

  [[nodiscard]] objects::ClassId class_of(const objects::ClassTable& table) const {
    for (int id = 0; id < table.size(); ++id) {
      const auto& candidate = table[static_cast<objects::ClassId>(id)];
      const bool object =
          candidate.shape == objects::Shape::cuboid || candidate.shape == objects::Shape::cylinder;
      if (object && candidate.name == fields_[3]) return static_cast<objects::ClassId>(id);
    }
    fail(3, "a class of cuboids or cylinders");
  }

  std::string where_;
  std::vector<std::string> fields_;
};

}  // namespace

Sample sample_of(const objects::Measurement& measurement, const objects::Model& measured,
                 const objects::Model& truth, const Eigen::Vector3d& eye) {
  Sample sample;
  sample.class_id = measurement.class_id;
  sample.view = view_of(eye, truth);
  sample.points = measurement.points;
  sample.confidence = measurement.class_probability[measurement.class_id];
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&truth)) {
    sample.error = error_of(std::get<objects::Cuboid>(measured), *cuboid);
    if (measurement.covariance.size() > 0) {
      sample.length_sd = objects::length_sd(measurement);
      sample.width_sd = objects::width_sd(measurement);
    }
  } else {
    sample.error =
        error_of(std::get<objects::Cylinder>(measured), std::get<objects::Cylinder>(truth), eye);
  }
  return sample;
}

bool is_whole(const Sample& sample, double most_length_sd_m) {
  return !(sample.length_sd > most_length_sd_m);
}

std::vector<Sample> read_samples(const std::filesystem::path& file,
                                 const objects::ClassTable& table) {
  const std::string text = core::read_file(file);
  if (text.empty() || text.back() != '\n') {
    throw Error(fmt::format("{}: cut: its last line has no end", file.string()));
  }
  const std::vector<std::string> lines = split(text, '\n');
  if (lines.front() != kHeader) {
    throw Error(fmt::format("{}:1: \"{}\", expected the header \"{}\"", file.string(),
                            lines.front(), kHeader));
  }
  std::vector<Sample> samples;
  for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
    samples.push_back(Line(file, i + 1, lines[i]).sample(table));
  }
  return samples;
}

std::string samples_text(const std::vector<Sample>& samples, const objects::ClassTable& table) {
  std::string text = kHeader + "\n";
  for (const Sample& sample : samples) text += line_of(sample, table);
  return text;
}

}  // namespace saker::uncertainty
