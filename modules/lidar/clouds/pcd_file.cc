#include <map>

#include "saker/lidar/bags/decompress.h"
#include "saker/lidar/clouds/cloud_file.h"

/// PCD 0.6 and 0.7, "The PCD (Point Cloud Data) file format" of the Point Cloud Library.
namespace saker::lidar {
namespace {

using Words = std::vector<std::string>;

constexpr long kMostFields = 256;
constexpr long kMostCount = 4096;

std::optional<NumberType> number_type(const std::string& kind, long size) {
  static const std::map<std::pair<std::string, long>, NumberType> known = {
      {{"F", 4}, NumberType::kF32}, {{"F", 8}, NumberType::kF64}, {{"I", 1}, NumberType::kI8},
      {{"I", 2}, NumberType::kI16}, {{"I", 4}, NumberType::kI32}, {{"I", 8}, NumberType::kI64},
      {{"U", 1}, NumberType::kU8},  {{"U", 2}, NumberType::kU16}, {{"U", 4}, NumberType::kU32},
      {{"U", 8}, NumberType::kU64}};
  const auto found = known.find({kind, size});
  if (found == known.end()) return std::nullopt;
  return found->second;
}

struct Head {
  std::map<std::string, Words> lines;

  [[nodiscard]] const Words& operator[](const char* key) const {
    static const Words none;
    const auto found = lines.find(key);
    return found == lines.end() ? none : found->second;
  }

  [[nodiscard]] long number(const char* key, long otherwise) const {
    const Words& words = (*this)[key];
    return words.empty() ? otherwise : whole_number(words[0], static_cast<long>(kMostCloudPoints));
  }
};

std::string read_head(Cursor& cursor, Head& head) {
  Words words;
  while (head.lines.size() < 32) {
    if (!next_line(cursor, words)) return "the head ends early, expected a line DATA";
    if (words.empty() || words[0][0] == '#') continue;
    const std::string key = words[0];
    words.erase(words.begin());
    head.lines[key] = words;
    if (key == "DATA") return "";
  }
  return "more lines of a head than there are kinds, expected a line DATA";
}

/// Every element of a field that has several is one of its own, so that text has as many numbers.
std::string make_layout(const Head& head, Cloud& cloud) {
  const Words& names = head["FIELDS"];
  if (names.empty() || static_cast<long>(names.size()) > kMostFields) {
    return "FIELDS: " + std::to_string(names.size()) + " names, expected 1 to 256";
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto word = [&](const char* key, const char* otherwise) {
      const Words& words = head[key];
      return words.empty() ? std::string(otherwise) : i < words.size() ? words[i] : std::string();
    };
    const auto type = number_type(word("TYPE", "F"), whole_number(word("SIZE", "4"), 8));
    const long count = whole_number(word("COUNT", "1"), kMostCount);
    if (!type) {
      return "field " + names[i] + ": TYPE " + word("TYPE", "F") + " SIZE " + word("SIZE", "4") +
             ", expected F, I or U of 1, 2, 4 or 8 bytes";
    }
    if (count < 0) return "field " + names[i] + ": COUNT " + word("COUNT", "1");
    for (long k = 0; k < count; ++k) {
      cloud.layout.append(k == 0 ? names[i] : names[i] + "_" + std::to_string(k), *type);
    }
  }
  return "";
}

/// From all of the first field, all of the second, … to records.
std::string interleave(const std::vector<std::uint8_t>& planes, std::size_t points, Cloud& cloud) {
  cloud.bytes.resize(points * cloud.layout.step);
  std::size_t from = 0;
  for (const PointField& field : cloud.layout.fields) {
    const std::size_t size = bytes_of(field.type);
    for (std::size_t i = 0; i < points; ++i, from += size) {
      std::memcpy(&cloud.bytes[i * cloud.layout.step + field.offset], &planes[from], size);
    }
  }
  return "";
}

std::string read_compressed(Cursor& cursor, std::size_t points, Cloud& cloud) {
  const auto packed = cursor.number<std::uint32_t>();
  const auto unpacked = cursor.number<std::uint32_t>();
  const ByteView bytes = cursor.take(packed);
  if (!cursor.ok()) return "cut: " + std::to_string(packed) + " compressed bytes expected";
  if (unpacked != points * cloud.layout.step) {
    return std::to_string(unpacked) + " bytes, expected " + std::to_string(points) + " points of " +
           std::to_string(cloud.layout.step);
  }
  std::vector<std::uint8_t> planes;
  if (!decompress_lzf(bytes, unpacked, planes)) return "compressed bytes are damaged";
  return interleave(planes, points, cloud);
}

}  // namespace

std::string parse_pcd(ByteView bytes, Cloud& cloud) {
  cloud = {};
  Cursor cursor(bytes);
  Head head;
  if (std::string fault = read_head(cursor, head); !fault.empty()) return fault;
  if (std::string fault = make_layout(head, cloud); !fault.empty()) return fault;
  const long width = head.number("WIDTH", -1), height = head.number("HEIGHT", 1);
  const bool sized = width >= 0 && height >= 0;
  const long points = head.number("POINTS", sized ? width * height : -1);
  if (points < 0 || points > static_cast<long>(kMostCloudPoints)) {
    return "POINTS, or WIDTH and HEIGHT: expected 0 to " + std::to_string(kMostCloudPoints);
  }
  if (points == 0) return "holds no points";
  const bool organised = width > 0 && height > 1 && width * height == points;
  cloud.rows = organised ? static_cast<std::size_t>(height) : 1;
  cloud.columns = static_cast<std::size_t>(organised ? width : points);
  const auto count = static_cast<std::size_t>(points);
  const Words& data = head["DATA"];
  const std::string kind = data.empty() ? "" : data[0];
  if (kind == "ascii") return parse_text_points(cursor, count, cloud);
  if (kind == "binary_compressed") return read_compressed(cursor, count, cloud);
  if (kind != "binary") return "DATA " + kind + ", expected ascii, binary or binary_compressed";
  const ByteView records = cursor.take(count * cloud.layout.step);
  if (!cursor.ok()) {
    return "cut: " + std::to_string(cursor.left()) + " bytes of points, expected " +
           std::to_string(count * cloud.layout.step);
  }
  cloud.bytes.assign(records.begin(), records.end());
  return "";
}

}  // namespace saker::lidar
