#include <regex>

#include "saker/lidar/clouds/cloud_file.h"
#include "saker/lidar/clouds/float_rows.h"

/// NumPy's .npy, versions 1 to 3 ("NEP 1 — A simple file format for NumPy arrays").
namespace saker::lidar {
namespace {

constexpr std::size_t kMagicBytes = 6;
constexpr std::size_t kMostColumns = 64;

/// "<f4"; of records every part says its order.
std::optional<NumberType> number_type(const std::string& text, bool& big_endian) {
  if (text.size() < 3) return std::nullopt;
  big_endian = text[0] == '>';
  const std::string kind = text.substr(1);
  if (kind == "f4") return NumberType::kF32;
  if (kind == "f8") return NumberType::kF64;
  if (kind == "i1") return NumberType::kI8;
  if (kind == "u1") return NumberType::kU8;
  if (kind == "i2") return NumberType::kI16;
  if (kind == "u2") return NumberType::kU16;
  if (kind == "i4") return NumberType::kI32;
  if (kind == "u4") return NumberType::kU32;
  if (kind == "i8") return NumberType::kI64;
  if (kind == "u8") return NumberType::kU64;
  return std::nullopt;
}

struct Head {
  std::string text;
  std::vector<std::size_t> shape;
  bool by_columns = false;
};

std::string read_head(Cursor& cursor, Head& head) {
  cursor.skip(kMagicBytes);
  const auto version = cursor.number<std::uint8_t>();
  cursor.skip(1);
  const std::size_t size =
      version == 1 ? cursor.number<std::uint16_t>() : cursor.number<std::uint32_t>();
  head.text = std::string(text_of(cursor.take(size)));
  if (!cursor.ok() || head.text.size() > 65536) return "the head is cut";
  std::smatch found;
  if (!std::regex_search(head.text, found, std::regex(R"('shape'\s*:\s*\(([0-9, ]*)\))"))) {
    return "no shape in its head";
  }
  const std::string shape = found[1];
  const std::regex digits("[0-9]+");
  for (std::sregex_iterator it(shape.begin(), shape.end(), digits), end; it != end; ++it) {
    const long length = whole_number(it->str(), static_cast<long>(kMostCloudPoints));
    if (length < 0) return "shape (" + shape + "), expected a cloud";
    head.shape.push_back(static_cast<std::size_t>(length));
  }
  head.by_columns = head.text.find("'fortran_order': True") != std::string::npos;
  return "";
}

/// Records: [('x', '<f4'), ('y', '<f4'), …].
std::string record_layout(const std::string& text, Cloud& cloud) {
  const std::regex part(R"(\(\s*'([^']*)'\s*,\s*'([<>|=][a-zA-Z][0-9]+)'\s*\))");
  for (std::sregex_iterator it(text.begin(), text.end(), part), end; it != end; ++it) {
    const auto type = number_type((*it)[2], cloud.layout.big_endian);
    if (!type) return "field " + (*it)[1].str() + ": type " + (*it)[2].str();
    cloud.layout.append((*it)[1], *type);
  }
  return cloud.layout.fields.empty() ? "no fields in its head" : "";
}

/// Rows of numbers without names: what the columns are is found from the numbers.
std::string row_layout(const Head& head, ByteView bytes, const std::string& type_text,
                       Cloud& cloud) {
  bool big_endian = false;
  const auto type = number_type(type_text, big_endian);
  if (!type || (*type != NumberType::kF32 && *type != NumberType::kF64)) {
    return "type " + type_text + ", expected float32 or float64";
  }
  const std::size_t columns = head.shape.back();
  if (columns < 3 || columns > kMostColumns) {
    return std::to_string(columns) + " columns, expected x, y, z and what else there is";
  }
  const std::size_t rows = bytes.size() / bytes_of(*type) / columns;
  std::vector<float> values;
  Cursor cursor(bytes, big_endian);
  for (std::size_t i = 0; i < rows * columns; ++i) {
    values.push_back(*type == NumberType::kF32 ? cursor.number<float>()
                                               : static_cast<float>(cursor.number<double>()));
  }
  cloud.layout.big_endian = big_endian;
  for (const std::string& name : name_columns(values, columns)) cloud.layout.append(name, *type);
  return "";
}

}  // namespace

std::string parse_npy(ByteView bytes, Cloud& cloud) {
  cloud = {};
  Cursor cursor(bytes);
  Head head;
  if (std::string fault = read_head(cursor, head); !fault.empty()) return fault;
  if (head.by_columns && head.shape.size() > 1) return "fortran_order, expected rows of points";
  const ByteView data = cursor.take_at_most(cursor.left());
  std::smatch found;
  std::string fault;
  const bool rows = std::regex_search(head.text, found, std::regex(R"('descr'\s*:\s*'([^']*)')"));
  if (rows && head.shape.size() < 2) return "one column, expected rows of points";
  fault = rows ? row_layout(head, data, found[1], cloud) : record_layout(head.text, cloud);
  if (!fault.empty()) return fault;
  std::size_t points = 1;
  for (std::size_t i = 0; i + (rows ? 1 : 0) < head.shape.size(); ++i) {
    points *= head.shape[i];
    if (points > kMostCloudPoints) return "more points than a cloud has";
  }
  if (points == 0) return "holds no points";
  if (data.size() < points * cloud.layout.step) {
    return "cut: " + std::to_string(data.size()) + " bytes, expected " +
           std::to_string(points * cloud.layout.step);
  }
  cloud.columns = points;
  cloud.bytes.assign(data.begin(),
                     data.begin() + static_cast<std::ptrdiff_t>(points * cloud.layout.step));
  return "";
}

}  // namespace saker::lidar
