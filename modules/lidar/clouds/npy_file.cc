#include <cctype>
#include <map>
#include <utility>

#include "saker/lidar/clouds/cloud_file.h"
#include "saker/lidar/clouds/float_rows.h"

/// NumPy's .npy, versions 1 to 3 ("NEP 1 — A simple file format for NumPy arrays").
namespace saker::lidar {
namespace {

constexpr std::size_t kMagicBytes = 6;
constexpr std::size_t kLargestHead = 65536;
constexpr std::size_t kMostColumns = 64;
constexpr long kMostBytesBetween = 4096;  // two fields of a record

std::optional<NumberType> number_type(std::string_view kind) {
  static const std::map<std::string_view, NumberType> known = {
      {"f4", NumberType::kF32}, {"f8", NumberType::kF64}, {"i1", NumberType::kI8},
      {"u1", NumberType::kU8},  {"i2", NumberType::kI16}, {"u2", NumberType::kU16},
      {"i4", NumberType::kI32}, {"u4", NumberType::kU32}, {"i8", NumberType::kI64},
      {"u8", NumberType::kU64}};
  const auto found = known.find(kind);
  if (found == known.end()) return std::nullopt;
  return found->second;
}

/// A head is a Python literal. Its words: names, numbers, marks, and strings behind a quote.
class Words {
 public:
  explicit Words(std::string_view text) {
    while (!text.empty()) {
      std::size_t size = 1;
      if (text[0] == '\'' || text[0] == '"') {
        const std::size_t end = std::min(text.find(text[0], 1), text.size());
        all_.emplace_back(text.substr(0, end));
        all_.back()[0] = '\'';
        size = std::min(end + 1, text.size());
      } else if (std::isalnum(static_cast<unsigned char>(text[0])) != 0) {
        while (size < text.size() && std::isalnum(static_cast<unsigned char>(text[size])) != 0)
          ++size;
        all_.emplace_back(text.substr(0, size));
      } else if (std::isspace(static_cast<unsigned char>(text[0])) == 0) {
        all_.emplace_back(text.substr(0, 1));
      }
      text.remove_prefix(size);
    }
  }

  /// Goes to the value of a key; false where there is none.
  bool find(const std::string& key) {
    for (at_ = 0; at_ + 2 < all_.size(); ++at_) {
      if (all_[at_] != "'" + key || all_[at_ + 1] != ":") continue;
      at_ += 2;
      return true;
    }
    return false;
  }

  /// The next word, empty behind the last.
  [[nodiscard]] const std::string& peek() const {
    static const std::string none;
    return at_ < all_.size() ? all_[at_] : none;
  }
  std::string take() {
    std::string word = peek();
    ++at_;
    return word;
  }
  bool take(std::string_view word) {
    if (peek() != word) return false;
    ++at_;
    return true;
  }
  [[nodiscard]] bool at_string() const { return peek().substr(0, 1) == "'"; }

 private:
  std::vector<std::string> all_;
  std::size_t at_ = 0;
};

/// "(400, 4)"; nothing where it is none.
std::optional<std::vector<std::size_t>> take_shape(Words& words) {
  std::vector<std::size_t> shape;
  if (!words.take("(")) return std::nullopt;
  while (!words.take(")")) {
    const long length = whole_number(words.take(), static_cast<long>(kMostCloudPoints));
    if (length < 0) return std::nullopt;
    shape.push_back(static_cast<std::size_t>(length));
    if (!words.take(",") && words.peek() != ")") return std::nullopt;
  }
  return shape;
}

struct Head {
  Words words;
  std::vector<std::size_t> shape;
  bool by_columns = false;
};

std::optional<Head> read_head(Cursor& cursor, std::string& fault) {
  cursor.skip(kMagicBytes);
  const auto version = cursor.number<std::uint8_t>();
  cursor.skip(1);
  const std::size_t size =
      version == 1 ? cursor.number<std::uint16_t>() : cursor.number<std::uint32_t>();
  const std::string_view text = text_of(cursor.take(size));
  fault = "the head is cut";
  if (!cursor.ok() || text.size() > kLargestHead) return std::nullopt;
  Head head{Words(text), {}, false};
  fault = "no shape in its head, expected (points, columns)";
  if (!head.words.find("shape")) return std::nullopt;
  const auto shape = take_shape(head.words);
  if (!shape) return std::nullopt;
  head.shape = *shape;
  head.by_columns = head.words.find("fortran_order") && head.words.peek() == "True";
  fault.clear();
  return head;
}

/// The orders of bytes that a head names. Numbers of one byte have none.
class ByteOrder {
 public:
  /// False where it is another than before, or none that is known.
  bool take(char mark) {
    if (mark == '|') return true;
    const bool big = mark == '>';
    if (!big && mark != '<' && mark != '=') return false;
    return std::exchange(known_, true) ? big == big_ : ((big_ = big), true);
  }
  [[nodiscard]] bool big_endian() const { return big_; }

 private:
  bool known_ = false, big_ = false;
};

/// ('x', '<f4'), or several of a name, ('d', '<f4', (4,)), or bytes between, ('', '|V4').
std::string take_field(Words& words, ByteOrder& order, PointLayout& layout) {
  const std::string expected = ", expected ('x', '<f4'), ('y', '<f4') and so on";
  if (!words.take("(") || !words.at_string()) return "no field of a point" + expected;
  const std::string name = words.take().substr(1);
  if (!words.take(",") || !words.at_string()) return "field " + name + ": no type" + expected;
  const std::string type_text = words.take().substr(1);
  std::size_t count = 1;
  if (words.take(",") && words.peek() == "(") {
    const auto shape = take_shape(words);
    if (!shape || shape->size() != 1 || shape->front() > kMostColumns) {
      return "field " + name + ": more than a row of numbers" + expected;
    }
    count = shape->front();
  }
  if (!words.take(")")) return "field " + name + ": not understood" + expected;
  const std::string kind = type_text.substr(std::min<std::size_t>(1, type_text.size()));
  const long between =
      kind.substr(0, 1) == "V" ? whole_number(kind.substr(1), kMostBytesBetween) : -1;
  if (between >= 0) {
    layout.step += static_cast<std::size_t>(between) * count;
    return "";
  }
  const auto type = number_type(kind);
  if (!type) return "field " + name + ": type " + type_text + expected;
  if (!order.take(type_text[0])) return "field " + name + ": numbers of several orders of bytes";
  for (std::size_t k = 0; k < count; ++k) {
    layout.append(k == 0 ? name : name + "_" + std::to_string(k), *type);
  }
  return "";
}

/// Records: [('x', '<f4'), ('y', '<f4'), …].
std::string record_layout(Words& words, Cloud& cloud) {
  ByteOrder order;
  if (!words.take("[")) return "no fields in its head";
  while (!words.take("]")) {
    if (std::string fault = take_field(words, order, cloud.layout); !fault.empty()) return fault;
    (void)words.take(",");
  }
  cloud.layout.big_endian = order.big_endian();
  return cloud.layout.fields.empty() ? "no fields in its head" : "";
}

/// Rows of numbers without names: what the columns are is found from the numbers.
std::string row_layout(std::size_t columns, ByteView bytes, const std::string& type_text,
                       Cloud& cloud) {
  ByteOrder order;
  const auto type = number_type(type_text.substr(std::min<std::size_t>(1, type_text.size())));
  if (!type || !order.take(type_text[0]) ||
      (*type != NumberType::kF32 && *type != NumberType::kF64)) {
    return "type " + type_text + ", expected float32 or float64";
  }
  if (columns < 3 || columns > kMostColumns) {
    return std::to_string(columns) + " columns, expected x, y, z and what else there is";
  }
  const std::size_t rows = bytes.size() / bytes_of(*type) / columns;
  std::vector<float> values;
  Cursor cursor(bytes, order.big_endian());
  for (std::size_t i = 0; i < rows * columns; ++i) {
    values.push_back(*type == NumberType::kF32 ? cursor.number<float>()
                                               : static_cast<float>(cursor.number<double>()));
  }
  cloud.layout.big_endian = order.big_endian();
  for (const std::string& name : name_columns(values, columns)) cloud.layout.append(name, *type);
  return "";
}

}  // namespace

std::string parse_npy(ByteView bytes, Cloud& cloud) {
  cloud = {};
  Cursor cursor(bytes);
  std::string fault;
  std::optional<Head> head = read_head(cursor, fault);
  if (!head) return fault;
  if (head->by_columns && head->shape.size() > 1) return "fortran_order, expected rows of points";
  if (!head->words.find("descr")) return "no descr in its head, expected the type of its numbers";
  const ByteView data = cursor.take_at_most(cursor.left());
  const bool rows = head->words.at_string();
  if (rows && head->shape.size() < 2) return "one column, expected rows of points";
  fault = rows ? row_layout(head->shape.back(), data, head->words.take().substr(1), cloud)
               : record_layout(head->words, cloud);
  if (!fault.empty()) return fault;
  std::size_t points = 1;
  for (std::size_t i = 0; i + (rows ? 1 : 0) < head->shape.size(); ++i) {
    points *= head->shape[i];
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
