#include "made_clouds.h"

#include <array>
#include <cstdio>

namespace saker::lidar::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

void put_text(Bytes& bytes, const std::string& text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void put_field(Bytes& bytes, const MadePoint& p, int field, bool big_endian) {
  if (field == 4) return put(bytes, p.t, big_endian);
  if (field == 5) return put(bytes, p.ring, big_endian);
  put(bytes, std::array{p.x, p.y, p.z, p.intensity}[static_cast<std::size_t>(field)], big_endian);
}

constexpr int kFields = 6;

Bytes records(const std::vector<MadePoint>& points, bool big_endian = false) {
  Bytes bytes;
  for (const MadePoint& p : points) {
    for (int field = 0; field < kFields; ++field) put_field(bytes, p, field, big_endian);
  }
  return bytes;
}

/// All of the first field, all of the second, …
Bytes planes(const std::vector<MadePoint>& points) {
  Bytes bytes;
  for (int field = 0; field < kFields; ++field) {
    for (const MadePoint& p : points) put_field(bytes, p, field, false);
  }
  return bytes;
}

std::string lines(const std::vector<MadePoint>& points) {
  std::string text;
  for (const MadePoint& p : points) {
    std::array<char, 128> line = {};
    std::snprintf(line.data(), line.size(), "%.9g %.9g %.9g %.9g %u %u\n", static_cast<double>(p.x),
                  static_cast<double>(p.y), static_cast<double>(p.z),
                  static_cast<double>(p.intensity), p.t, unsigned{p.ring});
    text += line.data();
  }
  return text;
}

/// Literals only, as a packer may write them.
Bytes lzf_of(const Bytes& bytes) {
  Bytes packed;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::size_t count = std::min<std::size_t>(32, bytes.size() - at);
    packed.push_back(static_cast<std::uint8_t>(count - 1));
    packed.insert(packed.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                  bytes.begin() + static_cast<std::ptrdiff_t>(at + count));
  }
  return packed;
}

}  // namespace

Bytes made_pcd(const std::string& data, const std::vector<MadePoint>& points) {
  const std::string count = std::to_string(points.size());
  Bytes file;
  put_text(
      file,
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity t ring\n"
      "SIZE 4 4 4 4 4 2\nTYPE F F F F U U\nCOUNT 1 1 1 1 1 1\nWIDTH " +
          count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " + data + "\n");
  if (data == "ascii") {
    put_text(file, lines(points));
  } else if (data == "binary") {
    const Bytes all = records(points);
    file.insert(file.end(), all.begin(), all.end());
  } else {
    const Bytes all = planes(points), packed = lzf_of(all);
    put(file, static_cast<std::uint32_t>(packed.size()));
    put(file, static_cast<std::uint32_t>(all.size()));
    file.insert(file.end(), packed.begin(), packed.end());
  }
  return file;
}

Bytes made_ply(const std::string& format, const std::vector<MadePoint>& points) {
  Bytes file;
  put_text(file, "ply\nformat " + format + " 1.0\ncomment made\nelement vertex " +
                     std::to_string(points.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nproperty float "
                     "scalar_Intensity\nproperty uint t\nproperty ushort ring\nelement face 0\n"
                     "property list uchar int vertex_indices\nend_header\n");
  if (format == "ascii") {
    put_text(file, lines(points));
    return file;
  }
  const Bytes all = records(points, format == "binary_big_endian");
  file.insert(file.end(), all.begin(), all.end());
  return file;
}

Bytes npy_of(const std::string& descr, const std::string& shape, const Bytes& data) {
  const std::string head =
      "{'descr': " + descr + ", 'fortran_order': False, 'shape': (" + shape + "), }\n";
  Bytes file;
  put_text(file, "\x93NUMPY");
  put(file, std::uint8_t{1});
  put(file, std::uint8_t{0});
  put(file, static_cast<std::uint16_t>(head.size()));
  put_text(file, head);
  file.insert(file.end(), data.begin(), data.end());
  return file;
}

Bytes made_npy(const std::vector<MadePoint>& points) {
  return npy_of(
      "[('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('intensity', '<f4'), ('t', '<u4'), ('ring', "
      "'<u2')]",
      std::to_string(points.size()) + ",", records(points));
}

Bytes made_floats(const std::vector<MadePoint>& points) {
  Bytes bytes;
  for (const MadePoint& p : points) {
    for (const float value : {p.x, p.y, p.z, p.intensity, static_cast<float>(p.ring),
                              static_cast<float>(static_cast<double>(p.t) * 1e-9)}) {
      put(bytes, value);
    }
  }
  return bytes;
}

}  // namespace saker::lidar::testing
