#include "saker/lidar/clouds/cloud_file.h"

#include <cstdlib>

#include "saker/lidar/file_bytes.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kLargestFile = std::size_t{2} << 30;
constexpr std::size_t kLongestLine = 1 << 16;

bool begins(ByteView bytes, std::string_view text) {
  return text_of(bytes).substr(0, text.size()) == text;
}

std::string_view next_line(Cursor& cursor, bool& any) {
  const ByteView rest = cursor.take_at_most(kLongestLine);
  const std::string_view text = text_of(rest);
  any = !text.empty();
  return text.substr(0, text.find('\n'));
}

}  // namespace

CloudFormat cloud_format(ByteView begin) {
  if (begins(begin, "\x93NUMPY")) return CloudFormat::kNpy;
  if (begins(begin, "ply\n") || begins(begin, "ply\r")) return CloudFormat::kPly;
  for (const char* first : {"# .PCD", "VERSION ", "FIELDS ", "#.PCD", "# PCD"}) {
    if (begins(begin, first)) return CloudFormat::kPcd;
  }
  return CloudFormat::kNone;
}

std::string read_cloud(const std::filesystem::path& file, Cloud& cloud) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) return "cannot be read: " + error.message();
  if (size == 0) return "holds no points";
  if (size > kLargestFile) return std::to_string(size) + " bytes, expected at most 2 GiB";
  const std::vector<std::uint8_t> bytes = first_bytes(file, size);
  switch (cloud_format(bytes)) {
    case CloudFormat::kPcd:
      return parse_pcd(bytes, cloud);
    case CloudFormat::kPly:
      return parse_ply(bytes, cloud);
    case CloudFormat::kNpy:
      return parse_npy(bytes, cloud);
    case CloudFormat::kNone:
      break;
  }
  return "neither PCD nor PLY nor .npy";
}

bool next_line(Cursor& cursor, std::vector<std::string>& words) {
  Cursor ahead = cursor;
  bool any = false;
  const std::string_view line = next_line(ahead, any);
  words.clear();
  if (!any) return false;
  cursor.skip(std::min(line.size() + 1, cursor.left()));
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t\r,", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t\r,", at), line.size());
    words.emplace_back(line.substr(at, end - at));
    at = end;
  }
  return true;
}

long whole_number(const std::string& word, long most) {
  if (word.empty() || word.size() > 18 ||
      word.find_first_not_of("0123456789") != std::string::npos) {
    return -1;
  }
  const long value = std::strtol(word.c_str(), nullptr, 10);
  return value <= most ? value : -1;
}

std::string parse_text_points(Cursor& cursor, std::size_t points, Cloud& cloud) {
  const std::size_t fields = cloud.layout.fields.size();
  if (fields == 0) return "no fields, expected x, y and z";
  // A number has a digit at least, and a mark behind it but for the last one.
  if (points > (cursor.left() + 1) / (2 * fields)) {
    return std::to_string(points) + " points in " + std::to_string(cursor.left()) +
           " bytes of text";
  }
  PointLayout layout;
  for (const PointField& field : cloud.layout.fields) layout.append(field.name, NumberType::kF64);
  cloud.layout = layout;
  cloud.bytes.resize(points * layout.step);
  std::vector<std::string> words;
  for (std::size_t i = 0; i < points; ++i) {
    do {
      if (!next_line(cursor, words)) {
        return std::to_string(i) + " points, expected " + std::to_string(points);
      }
    } while (words.empty());
    if (words.size() < fields) {
      return "point " + std::to_string(i) + ": " + std::to_string(words.size()) +
             " numbers, expected " + std::to_string(fields);
    }
    for (std::size_t k = 0; k < fields; ++k) {
      char* end = nullptr;
      const double value = std::strtod(words[k].c_str(), &end);
      if (end == words[k].c_str()) {
        return "point " + std::to_string(i) + ": \"" + words[k].substr(0, 20) +
               "\", expected a number";
      }
      std::memcpy(&cloud.bytes[i * layout.step + k * sizeof value], &value, sizeof value);
    }
  }
  return "";
}

}  // namespace saker::lidar
