#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "saker/core/error.h"
#include "saker/objects/comparison.h"
#include "saker/objects/consistency.h"
#include "saker/objects/map_io.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/map/map_merge.h"

namespace saker::tools {
namespace {

using Json = nlohmann::ordered_json;

struct MapOptions {
  std::string first, second;
  bool json = false;
  bool force = false;
  bool compact = false;
  std::vector<double> region;  ///< least x and y, most x and y
  std::vector<double> origin;  ///< latitude, longitude
  double heading_deg = 90;
  objects::ComparisonOptions comparison;
};

objects::ClassTable classes(const CommonOptions& common) {
  return read_configuration(common).autonomy.objects;
}

/// As site.origin has it: latitude, longitude and, where it is not 90, heading of x.
std::optional<objects::GeoOrigin> origin_of(const std::vector<double>& site) {
  if (site.empty()) return std::nullopt;
  if (site.size() != 2 && site.size() != 3) {
    throw Error(fmt::format("site.origin: {} numbers, expected latitude, longitude and heading",
                            site.size()));
  }
  objects::GeoOrigin origin{.latitude_deg = site[0], .longitude_deg = site[1]};
  if (site.size() == 3) origin.heading_deg = site[2];
  return origin;
}

/// One line on stderr where parts of the file could not be read. \return the exit status
int tell_damage(const char* command, const std::vector<std::string>& damage) {
  if (damage.empty()) return 0;
  std::cerr << fmt::format("{}: {}", command, damage.front());
  if (damage.size() > 1) std::cerr << fmt::format(" (and {} more)", damage.size() - 1);
  std::cerr << "\n";
  return 1;
}

// saker map info

std::string describe(const objects::SmapLayout& layout, std::size_t objects) {
  std::string line = fmt::format(".smap version {}, {} bytes", layout.version, layout.bytes);
  if (layout.version == 1) return line + "\n";
  line += fmt::format(": heads 2 x {}, {} tiles of {:.0f} m: geometry {}, ground {}, details {}\n",
                      layout.head_bytes, layout.tiles, layout.tile_m, layout.geometry_bytes,
                      layout.ground_bytes, layout.detail_bytes);
  if (objects == 0) return line;
  const double count = static_cast<double>(objects);
  return line + fmt::format("bytes an object  {:.2f} in all, {:.2f} geometry, {:.2f} details\n",
                            static_cast<double>(layout.bytes) / count,
                            static_cast<double>(layout.geometry_bytes) / count,
                            static_cast<double>(layout.detail_bytes) / count);
}

std::string describe(const objects::MapObject& object, const objects::ClassTable& table) {
  const Eigen::Vector3d at = objects::place(object.model);
  std::string line =
      fmt::format("{:5d}  {:8}  {:4.2f}  {:4d}  ({:8.2f}, {:8.2f}, {:7.2f})  ", object.id,
                  table[object.class_id].name, object.class_probability[object.class_id],
                  object.observations, at.x(), at.y(), at.z());
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&object.model)) {
    return line + fmt::format("{:.2f} x {:.2f} x {:.2f} m, heading {:.1f} degrees\n",
                              cuboid->size.x(), cuboid->size.y(), cuboid->size.z(),
                              core::yaw(cuboid->pose.linear()) * 57.29577951308232);
  }
  const auto& cylinder = std::get<objects::Cylinder>(object.model);
  return line + fmt::format("radius {:.3f} m, height {:.2f} m\n", cylinder.radius, cylinder.height);
}

int info(const MapOptions& options, const CommonOptions& common) {
  const objects::ClassTable table = classes(common);
  const objects::MapRead read = objects::read_map_part(options.first, table, objects::kEverywhere);
  const objects::ObjectMap& map = read.map;
  std::map<std::string, int> counts;
  for (const auto& object : map.objects) ++counts[table[object.class_id].name];
  std::cout << fmt::format("frame {}, {} objects, {} ground planes\n", map.frame,
                           map.objects.size(), map.ground.size());
  if (const auto layout = objects::smap_layout(options.first)) {
    std::cout << describe(*layout, map.objects.size());
  }
  for (const auto& [name, count] : counts) std::cout << fmt::format("{:8}  {}\n", name, count);
  std::cout << "   id  class     prob   obs  place (m)\n";
  for (const auto& object : map.objects) std::cout << describe(object, table);
  return tell_damage("saker map info", read.damage);
}

// saker map convert

objects::Region region_of(const MapOptions& options) {
  if (options.region.empty()) return objects::kEverywhere;
  const Eigen::Map<const Eigen::Vector4d> corners(options.region.data());
  const objects::Region region(corners.head<2>(), corners.tail<2>());
  if (!region.isEmpty()) return region;
  throw Error(fmt::format("--region {}: expected XMIN,YMIN,XMAX,YMAX with the least first",
                          fmt::join(options.region, ",")));
}

objects::MapFormat format_of(const MapOptions& options, const std::vector<double>& site) {
  objects::MapFormat format{.origin = origin_of(site)};
  if (options.compact) format.content = objects::SmapContent::geometry;
  if (!options.origin.empty()) {
    format.origin = {options.origin[0], options.origin[1], options.heading_deg};
  }
  return format;
}

int convert(const MapOptions& options, const CommonOptions& common) {
  const flight::ProcessConfig config = read_configuration(common);
  const objects::ClassTable& table = config.autonomy.objects;
  const objects::MapRead read = objects::read_map_part(options.first, table, region_of(options));
  objects::write_map(output_file(options.second, options.force), read.map, table,
                     format_of(options, config.site.origin));
  return tell_damage("saker map convert", read.damage);
}

// saker map eval

/// A figure of too few objects is null.
Json number(double value) {
  return std::isfinite(value) ? Json(std::round(value * 1e4) / 1e4) : Json();
}

Json nees_json(const objects::ConsistencyFigures& nees) {
  return {{"size", number(nees.size)}, {"place", number(nees.place)}, {"objects", nees.objects}};
}

void print_nees(const objects::ConsistencyFigures& nees) {
  if (nees.objects == 0) return;
  std::cout << fmt::format(
      "  NEES a degree of freedom (1: honest)  size {:.2f}, place {:.2f} of {}\n", nees.size,
      nees.place, nees.objects);
}

Json class_json(const objects::ClassComparison& c) {
  Json entry = {{"truth", c.truth},   {"mapped", c.mapped},     {"found", c.found},
                {"missed", c.missed}, {"invented", c.invented}, {"duplicates", c.duplicates}};
  for (const objects::ErrorFigures& error : c.errors) {
    entry["errors"][error.quantity] = {{"mean", number(error.mean)},
                                       {"sd", number(error.standard_deviation)},
                                       {"mae", number(error.mean_absolute)}};
  }
  if (c.shape == objects::Shape::cuboid) {
    entry["front_right"] = c.front_right;
    entry["length_slope"] = number(c.length_slope);
    entry["size_mae_m"] = number(c.size_mae_m);
    entry["constant_size_mae_m"] = number(c.constant_size_mae_m);
  }
  return entry;
}

void print_class(const objects::ClassComparison& c) {
  std::cout << fmt::format(
      "{}: {} true, {} mapped: {} found, {} missed, {} invented, {} duplicates\n", c.name, c.truth,
      c.mapped, c.found, c.missed, c.invented, c.duplicates);
  if (c.found == 0) return;
  std::cout << "  error = mapped - true      mean        sd       MAE\n";
  for (const objects::ErrorFigures& error : c.errors) {
    std::cout << fmt::format("  {:20}  {:9.3f} {:9.3f} {:9.3f}\n", error.quantity, error.mean,
                             error.standard_deviation, error.mean_absolute);
  }
  if (c.shape != objects::Shape::cuboid) return;
  std::cout << fmt::format("  front in front          {} of {}\n", c.front_right, c.found);
  std::cout << fmt::format(
      "  length and width MAE    {:.3f} m; one box of the mean size for all: {:.3f} m\n",
      c.size_mae_m, c.constant_size_mae_m);
  std::cout << fmt::format("  slope of mapped on true length  {:.2f}\n", c.length_slope);
}

int eval(const MapOptions& options, const CommonOptions& common) {
  const objects::ClassTable table = classes(common);
  const objects::ObjectMap mapped = objects::read_map(options.first, table);
  const objects::ObjectMap truth = objects::read_map(options.second, table);
  const auto result = objects::compare(mapped, truth, table, options.comparison);
  const auto consistency = objects::consistency(mapped, truth, result);
  Json document = Json::object();
  for (const objects::ClassComparison& c : result) {
    if (c.truth + c.mapped == 0 && !options.json) continue;
    const auto nees = objects::mean_consistency(consistency, table.find(c.name));
    document[c.name] = class_json(c);
    document[c.name]["nees"] = nees_json(nees);
    if (options.json) continue;
    print_class(c);
    print_nees(nees);
  }
  if (options.json) std::cout << document.dump(1) << "\n";
  return 0;
}

void add_conversion(CLI::App& app, MapOptions& options) {
  app.add_option(
         "--region", options.region,
         "XMIN,YMIN,XMAX,YMAX: only what lies in there, m in the map's frame; of a .smap no "
         "more is read")
      ->delimiter(',')
      ->expected(4);
  app.add_flag("--compact", options.compact,
               "a .smap without identities, covariances and history: places within 1.8 cm, sizes "
               "1.5 cm, radii 0.5 cm, headings 0.5 degrees");
  CLI::Option* origin =
      app.add_option(
             "--origin", options.origin,
             "LAT,LON: of the map's origin, degrees (WGS 84), for a .geojson or .kml; without "
             "it site.origin")
          ->delimiter(',')
          ->expected(2);
  app.add_option("--heading", options.heading_deg,
                 "of the map's x axis with --origin, degrees clockwise from north; 90: x is east")
      ->needs(origin)
      ->capture_default_str();
  app.add_flag("--force", options.force, "replace a file that is there");
}

}  // namespace

void add_map(Commands& commands) {
  auto options = std::make_shared<MapOptions>();
  CLI::App& group =
      commands.add_group("map", "object maps: look at, convert, compare with the truth");

  CLI::App& info_app =
      commands.add(group,
                   {.name = "info",
                    .does = "what a map holds",
                    .output = Output::none,
                    .example = "saker map info out/map.json"},
                   [options](const CommonOptions& common) { return info(*options, common); });
  info_app.add_option("MAP", options->first, "map (.json or .smap)")->required();

  CLI::App& convert_app = commands.add(
      group,
      {.name = "convert",
       .does = "a .json or .smap into one of them or into .csv, .geojson, .kml or .ply; "
               "the ending decides",
       .output = Output::none,
       .example = "saker map convert out/map.smap map.json"},
      [options](const CommonOptions& common) { return convert(*options, common); });
  convert_app.add_option("A", options->first, "map to read")->required();
  convert_app.add_option("B", options->second, "file to write")->required();
  add_conversion(convert_app, *options);

  add_map_merge(commands, group);

  CLI::App& eval_app = commands.add(
      group,
      {.name = "eval",
       .does = "a map against the truth: found, missed, invented, duplicates, errors a class",
       .output = Output::none,
       .example = "saker map eval out/map.json flight/truth.json"},
      [options](const CommonOptions& common) { return eval(*options, common); });
  eval_app.add_option("MAP", options->first, "map to judge")->required();
  eval_app.add_option("TRUTH", options->second, "true map, in the same frame")->required();
  eval_app.add_flag("--json", options->json, "figures as JSON");
  eval_app
      .add_option("--gate", options->comparison.cuboid_gate_m,
                  "largest distance of a pair of cuboids in x-y, m")
      ->capture_default_str();
  eval_app
      .add_option("--cylinder-gate", options->comparison.cylinder_gate_m,
                  "the same of cylinders, m")
      ->capture_default_str();
  eval_app
      .add_option("--min-points", options->comparison.least_points,
                  "true objects that were hit by fewer returns do not count")
      ->capture_default_str();
}

}  // namespace saker::tools
