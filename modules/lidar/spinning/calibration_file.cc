#include "saker/lidar/spinning/calibration_file.h"

#include <yaml-cpp/yaml.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "saker/core/error.h"
#include "saker/core/one_line.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

constexpr std::array kExtensions = {".xml", ".yaml", ".yml", ".csv"};
constexpr double kDegrees = 180 / M_PI;
constexpr std::size_t kMostBytes = 4U << 20;

/// One beam of a file, whatever the file's units.
struct Entry {
  std::size_t beam = 0;
  double vertical_deg = 0, rotation_deg = 0;
  double distance_m = 0, distance_x_m = 0, distance_y_m = 0, up_m = 0, aside_m = 0;
  bool two_points = false;
};

/// Text between <tag> and </tag>, from `from` on.
std::optional<std::string> element(const std::string& text, const std::string& tag,
                                   std::size_t from = 0) {
  const auto begin = text.find("<" + tag + ">", from);
  if (begin == std::string::npos) return std::nullopt;
  const auto content = begin + tag.size() + 2;
  const auto end = text.find("</" + tag + ">", content);
  if (end == std::string::npos) return std::nullopt;
  return text.substr(content, end - content);
}

std::optional<double> number(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return std::nullopt;
  double value = 0;
  const auto result = std::from_chars(text.data() + begin, text.data() + text.size(), value);
  if (result.ec != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

double of_element(const std::string& text, const std::string& tag) {
  const auto content = element(text, tag);
  const auto value = content ? number(*content) : std::nullopt;
  if (!value) throw Error("no number in <" + tag + ">");
  return *value;
}

/// Velodyne's own: one <px …> a laser; lengths in cm.
std::vector<Entry> read_xml(const std::string& text) {
  std::vector<Entry> entries;
  for (std::size_t at = text.find("<px"); at != std::string::npos;) {
    const std::size_t next = text.find("<px", at + 1);
    const std::string laser = text.substr(at, next == std::string::npos ? next : next - at);
    at = next;
    if (!element(laser, "vertCorrection_")) continue;
    Entry entry;
    entry.beam = static_cast<std::size_t>(std::max(0., of_element(laser, "id_")));
    entry.vertical_deg = of_element(laser, "vertCorrection_");
    entry.rotation_deg = of_element(laser, "rotCorrection_");
    entry.distance_m = of_element(laser, "distCorrection_") / 100;
    entry.two_points = element(laser, "distCorrectionX_").has_value();
    if (entry.two_points) {
      entry.distance_x_m = of_element(laser, "distCorrectionX_") / 100;
      entry.distance_y_m = of_element(laser, "distCorrectionY_") / 100;
    }
    entry.up_m = of_element(laser, "vertOffsetCorrection_") / 100;
    entry.aside_m = of_element(laser, "horizOffsetCorrection_") / 100;
    entries.push_back(entry);
  }
  return entries;
}

std::vector<Entry> read_yaml(const std::string& text) {
  std::vector<Entry> entries;
  for (const YAML::Node& laser : YAML::Load(text)["lasers"]) {
    const auto of = [&](const char* key) { return laser[key] ? laser[key].as<double>() : 0.; };
    Entry entry;
    entry.beam = laser["laser_id"].as<std::size_t>();
    entry.vertical_deg = laser["vert_correction"].as<double>() * kDegrees;
    entry.rotation_deg = laser["rot_correction"].as<double>() * kDegrees;
    entry.distance_m = of("dist_correction");
    entry.two_points =
        laser["two_pt_correction_available"] && laser["two_pt_correction_available"].as<bool>();
    entry.distance_x_m = of("dist_correction_x");
    entry.distance_y_m = of("dist_correction_y");
    entry.up_m = of("vert_offset_correction");
    entry.aside_m = of("horiz_offset_correction");
    entries.push_back(entry);
  }
  return entries;
}

/// Hesai's: a line a channel, counted from 1; the azimuth is added to the rotor's.
std::vector<Entry> read_csv(const std::string& text) {
  std::vector<Entry> entries;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::array<std::optional<double>, 3> values;
    for (auto& value : values) {
      std::string cell;
      if (std::getline(cells, cell, ',')) value = number(cell);
    }
    if (!values[0] || *values[0] < 1 || !values[1] || !values[2]) continue;  // the head
    Entry entry;
    entry.beam = static_cast<std::size_t>(*values[0]) - 1;
    entry.vertical_deg = *values[1];
    entry.rotation_deg = -*values[2];
    entries.push_back(entry);
  }
  return entries;
}

std::vector<Entry> read_entries(const fs::path& file, const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first != std::string::npos && text[first] == '<') return read_xml(text);
  if (file.extension() == ".csv" || text.find("lasers") == std::string::npos) {
    return read_csv(text);
  }
  return read_yaml(text);
}

/// Beams of the file; those that fire twice a block have the same angles both times.
void take(const std::vector<Entry>& entries, SpinningModel& model) {
  const bool twice = model.kind == SpinningKind::kVlp16 || model.kind == SpinningKind::kVlp16HiRes;
  const std::size_t lasers = model.beams.size() / (twice ? 2 : 1);
  std::vector<bool> here(lasers);
  for (const Entry& entry : entries) {
    if (entry.beam >= lasers || here[entry.beam] || std::abs(entry.vertical_deg) > 90) {
      throw Error("laser " + std::to_string(entry.beam) + ", expected " + std::to_string(lasers) +
                  " of them, each once, between -90 and 90 degrees");
    }
    here[entry.beam] = true;
    for (std::size_t i = entry.beam; i < model.beams.size(); i += lasers) {
      SpinningBeam& beam = model.beams[i];
      beam.elevation_deg = entry.vertical_deg;
      beam.azimuth_deg = -entry.rotation_deg;
      beam.distance_m = entry.distance_m;
      beam.two_points = entry.two_points;
      beam.distance_x_m = entry.distance_x_m;
      beam.distance_y_m = entry.distance_y_m;
      beam.up_m = entry.up_m;
      beam.aside_m = entry.aside_m;
    }
  }
  if (entries.size() != lasers) {
    throw Error(std::to_string(entries.size()) + " lasers, expected " + std::to_string(lasers));
  }
}

}  // namespace

void read_calibration(const fs::path& file, SpinningModel& model) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error("cannot read calibration " + file.string());
  std::string text(kMostBytes, 0);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  try {
    take(read_entries(file, text), model);
  } catch (const std::exception& error) {  // Error, or what YAML finds
    throw Error(file.string() + ": no calibration of a " + model.name + ": " +
                one_line(error.what()));
  }
  model.needs_calibration = false;
  number_rings(model.beams);
}

fs::path find_calibration(const fs::path& capture) {
  std::error_code ignored;
  for (const char* extension : kExtensions) {
    const fs::path file = fs::path(capture).replace_extension(extension);
    if (fs::is_regular_file(file, ignored)) return file;
  }
  const fs::path vendors = capture.parent_path() / "db.xml";
  return fs::is_regular_file(vendors, ignored) ? vendors : fs::path();
}

}  // namespace saker::lidar
