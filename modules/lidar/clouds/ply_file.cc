#include <map>

#include "saker/lidar/clouds/cloud_file.h"

/// PLY 1.0, "The PLY polygon file format", G. Turk 1994: the element `vertex`.
namespace saker::lidar {
namespace {

using Words = std::vector<std::string>;

constexpr std::size_t kMostLines = 1000;

std::optional<NumberType> number_type(const std::string& name) {
  static const std::map<std::string, NumberType> known = {
      {"char", NumberType::kI8},     {"int8", NumberType::kI8},     {"uchar", NumberType::kU8},
      {"uint8", NumberType::kU8},    {"short", NumberType::kI16},   {"int16", NumberType::kI16},
      {"ushort", NumberType::kU16},  {"uint16", NumberType::kU16},  {"int", NumberType::kI32},
      {"int32", NumberType::kI32},   {"uint", NumberType::kU32},    {"uint32", NumberType::kU32},
      {"float", NumberType::kF32},   {"float32", NumberType::kF32}, {"double", NumberType::kF64},
      {"float64", NumberType::kF64}, {"int64", NumberType::kI64},   {"uint64", NumberType::kU64}};
  const auto found = known.find(name);
  if (found == known.end()) return std::nullopt;
  return found->second;
}

struct Element {
  std::string name;
  long count = 0;
  PointLayout layout;
  bool lists = false;
};

struct Head {
  std::string format;
  std::vector<Element> elements;  // up to the vertices
  bool vertices = false;
};

std::string take_line(const Words& words, Head& head) {
  if (words[0] == "format" && words.size() >= 2) head.format = words[1];
  if (words[0] == "element" && words.size() >= 3) {
    const long count = whole_number(words[2], static_cast<long>(kMostCloudPoints));
    if (count < 0) return "element " + words[1] + ": \"" + words[2] + "\" of them";
    head.elements.push_back({words[1], count, {}, false});
  }
  if (words[0] != "property" || words.size() < 3 || head.elements.empty()) return "";
  Element& element = head.elements.back();
  if (words[1] == "list") {
    element.lists = true;
    return "";
  }
  const auto type = number_type(words[1]);
  if (!type) return "property " + words[2] + ": type " + words[1] + " is unknown";
  element.layout.append(words[2], *type);
  return "";
}

std::string read_head(Cursor& cursor, Head& head) {
  Words words;
  for (std::size_t line = 0; line < kMostLines; ++line) {
    if (!next_line(cursor, words)) return "the head ends early, expected end_header";
    if (words.empty()) continue;
    if (words[0] == "end_header") return "";
    if (std::string fault = take_line(words, head); !fault.empty()) return fault;
  }
  return "a head of more than 1000 lines, expected end_header";
}

/// What stands before the vertices.
std::string skip(Cursor& cursor, const Element& element, bool text) {
  if (text) {
    Words words;
    for (long i = 0; i < element.count; ++i) {
      if (!next_line(cursor, words)) return "element " + element.name + " is cut";
    }
    return "";
  }
  if (element.lists) return "element " + element.name + ": lists before the vertices";
  cursor.skip(element.layout.step * static_cast<std::size_t>(element.count));
  return cursor.ok() ? "" : "element " + element.name + " is cut";
}

std::string read_vertices(Cursor& cursor, const Element& element, bool text, Cloud& cloud) {
  const auto count = static_cast<std::size_t>(element.count);
  cloud.layout.fields = element.layout.fields;
  cloud.layout.step = element.layout.step;
  cloud.columns = count;
  if (count == 0) return "holds no points";
  if (text) return parse_text_points(cursor, count, cloud);
  if (element.lists) return "element vertex: lists in it, expected numbers";
  const ByteView records = cursor.take(count * cloud.layout.step);
  if (!cursor.ok()) {
    return "cut: " + std::to_string(cursor.left()) + " bytes of points, expected " +
           std::to_string(count * cloud.layout.step);
  }
  cloud.bytes.assign(records.begin(), records.end());
  return "";
}

}  // namespace

std::string parse_ply(ByteView bytes, Cloud& cloud) {
  cloud = {};
  Cursor cursor(bytes);
  Head head;
  if (std::string fault = read_head(cursor, head); !fault.empty()) return fault;
  const bool text = head.format == "ascii";
  cloud.layout.big_endian = head.format == "binary_big_endian";
  if (!text && !cloud.layout.big_endian && head.format != "binary_little_endian") {
    return "format " + head.format + ", expected ascii, binary_little_endian or binary_big_endian";
  }
  for (const Element& element : head.elements) {
    if (element.name == "vertex") {
      if (text) cloud.layout.big_endian = false;
      return read_vertices(cursor, element, text, cloud);
    }
    if (std::string fault = skip(cursor, element, text); !fault.empty()) return fault;
  }
  return "no element vertex";
}

}  // namespace saker::lidar
