#include "saker/objects/map_io.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/map_document.h"
#include "saker/objects/map_export.h"
#include "saker/objects/map_kml.h"

namespace saker::objects {
namespace {

constexpr std::uint32_t kDocumentVersion = 1;

ObjectMap from_version_1(const std::string& bytes, const ClassTable& table,
                         const std::string& file) {
  Document document;
  try {
    document = Document::from_cbor(content_of(bytes));
  } catch (const Document::exception& error) {
    throw Error(fmt::format("{}: not a map: {}", file, error.what()));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file, error.what()));
  }
  return from_document(document, table, file);
}

bool is_version_1(const std::string& bytes) {
  return bytes.size() >= kFrameBytes && bytes.starts_with(kSmapMagic) &&
         version_of(bytes) == kDocumentVersion;
}

/// By its first bytes; where those are damaged, by its name.
bool is_smap(const std::string& beginning, const std::filesystem::path& file) {
  return beginning.starts_with(kSmapMagic) ||
         (file.extension() == ".smap" && !beginning.starts_with('{'));
}

std::string beginning_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(kFrameBytes, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

}  // namespace

std::string to_json(const ObjectMap& map, const ClassTable& table) {
  return to_document(map, table).dump(1) + "\n";
}

ObjectMap from_json(const std::string& text, const ClassTable& table, const std::string& file) {
  Document document;
  try {
    document = Document::parse(text);
  } catch (const Document::exception& error) {
    throw Error(fmt::format("{}: not JSON: {}", file, error.what()));
  }
  return from_document(document, table, file);
}

std::string to_smap(const ObjectMap& map, const ClassTable& table, SmapContent content) {
  return pack_smap(map, table, content);
}

ObjectMap from_smap(const std::string& bytes, const ClassTable& table, const std::string& file) {
  if (is_version_1(bytes)) return from_version_1(bytes, table, file);
  std::istringstream in(bytes);
  MapRead read = SmapReader(in, file).read(table);
  if (!read.damage.empty()) throw Error(read.damage.front());
  return std::move(read.map);
}

ObjectMap read_map(const std::filesystem::path& file, const ClassTable& table) {
  const std::string bytes = core::read_file(file);
  return is_smap(bytes, file) ? from_smap(bytes, table, file.string())
                              : from_json(bytes, table, file.string());
}

MapRead read_map_part(const std::filesystem::path& file, const ClassTable& table,
                      const Region& region) {
  const std::string beginning = beginning_of(file);
  if (!is_smap(beginning, file) || (beginning.starts_with(kSmapMagic) && is_version_1(beginning))) {
    return {.map = clipped(read_map(file, table), region), .damage = {}};
  }
  std::ifstream in(file, std::ios::binary);
  return SmapReader(in, file.string()).read(table, region);
}

std::optional<SmapLayout> smap_layout(const std::filesystem::path& file) {
  const std::string beginning = beginning_of(file);
  if (!is_smap(beginning, file)) return std::nullopt;
  if (is_version_1(beginning)) {
    return SmapLayout{.version = kDocumentVersion, .bytes = std::filesystem::file_size(file)};
  }
  std::ifstream in(file, std::ios::binary);
  const SmapReader reader(in, file.string());
  SmapLayout layout{.version = kSmapVersion,
                    .bytes = reader.bytes(),
                    .head_bytes = reader.head_bytes(),
                    .tiles = reader.head().tiles.size(),
                    .tile_m = reader.head().steps.tile_m()};
  for (const SmapTile& tile : reader.head().tiles) {
    layout.geometry_bytes += tile.geometry_bytes;
    layout.ground_bytes += tile.ground_bytes;
    layout.detail_bytes += tile.detail_bytes;
  }
  return layout;
}

void write_map(const std::filesystem::path& file, const ObjectMap& map, const ClassTable& table,
               const MapFormat& format) {
  const std::string ending = file.extension().string();
  if (ending == ".json") return core::write_file(file, to_json(map, table));
  if (ending == ".smap") return core::write_file(file, to_smap(map, table, format.content));
  if (ending == ".csv") return core::write_file(file, to_csv(map, table));
  if (ending == ".ply") return core::write_file(file, to_ply(map, table));
  const bool on_earth = ending == ".geojson" || ending == ".kml";
  if (on_earth && !format.origin) {
    throw Error(
        fmt::format("cannot write {}: needs the map's origin (--origin LAT,LON)", file.string()));
  }
  if (ending == ".geojson") return core::write_file(file, to_geojson(map, table, *format.origin));
  if (ending == ".kml") return core::write_file(file, to_kml(map, table, *format.origin));
  throw Error(fmt::format(
      "cannot write {}: expected a name that ends in .csv, .geojson, .kml, .ply, .json or .smap",
      file.string()));
}

}  // namespace saker::objects
