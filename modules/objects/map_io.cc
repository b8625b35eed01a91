#include "objects/map_io.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/files.h"
#include "objects/map_document.h"

namespace saker::objects {
namespace {

constexpr char kMagic[] = "SMAP";
constexpr std::size_t kMagicSize = 4, kWord = 4, kHeaderSize = kMagicSize + 2 * kWord;
constexpr std::uint32_t kVersion = 1;

/// CRC-32 of IEEE 802.3, as in zip files.
std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0);
  }
  return ~crc;
}

std::string word(std::uint32_t value) {
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(value >> shift));
  return bytes;
}

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = kWord; i-- > 0;)
    value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
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

std::string to_smap(const ObjectMap& map, const ClassTable& table) {
  const std::vector<std::uint8_t> packed = Document::to_cbor(to_document(map, table));
  const std::string body(packed.begin(), packed.end());
  return kMagic + word(kVersion) + word(static_cast<std::uint32_t>(body.size())) + body +
         word(checksum(body));
}

ObjectMap from_smap(const std::string& bytes, const ClassTable& table, const std::string& file) {
  if (bytes.size() < kHeaderSize + kWord || !bytes.starts_with(kMagic)) {
    throw Error(fmt::format("{}: {} bytes, expected a .smap file", file, bytes.size()));
  }
  const std::uint32_t version = word_at(bytes, kMagicSize);
  if (version != kVersion) {
    throw Error(fmt::format("{}: .smap version {}, expected {}", file, version, kVersion));
  }
  const std::size_t expected = kHeaderSize + word_at(bytes, kMagicSize + kWord) + kWord;
  if (bytes.size() != expected) {
    throw Error(fmt::format("{}: {} bytes, expected {} (cut?)", file, bytes.size(), expected));
  }
  const std::string body = bytes.substr(kHeaderSize, bytes.size() - kHeaderSize - kWord);
  if (checksum(body) != word_at(bytes, bytes.size() - kWord)) {
    throw Error(fmt::format("{}: wrong checksum, the file is damaged", file));
  }
  try {
    return from_document(Document::from_cbor(body), table, file);
  } catch (const Document::exception& error) {
    throw Error(fmt::format("{}: not a map: {}", file, error.what()));
  }
}

ObjectMap read_map(const std::filesystem::path& file, const ClassTable& table) {
  const std::string bytes = core::read_file(file);
  return bytes.starts_with(kMagic) ? from_smap(bytes, table, file.string())
                                   : from_json(bytes, table, file.string());
}

void write_map(const std::filesystem::path& file, const ObjectMap& map, const ClassTable& table) {
  const std::string ending = file.extension().string();
  if (ending != ".json" && ending != ".smap") {
    throw Error(
        fmt::format("cannot write {}: expected a name that ends in .json or .smap", file.string()));
  }
  const std::string bytes = ending == ".smap" ? to_smap(map, table) : to_json(map, table);
  core::write_file(file, bytes);
}

}  // namespace saker::objects
