#include "saker/lidar/recording_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string>

#include "saker/core/error.h"
#include "saker/lidar/bags/decompress.h"
#include "saker/lidar/bags/unpacked_file.h"
#include "saker/lidar/clouds/cloud_file.h"
#include "saker/lidar/clouds/cloud_folder.h"
#include "saker/lidar/clouds/natural_order.h"
#include "saker/lidar/file_bytes.h"
#include "saker/lidar/kitti_folder.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFirstBytes = 32;
constexpr std::size_t kOsfMagicAt = 8;

bool is_capture(ByteView begin) {
  const std::uint32_t word = Cursor(begin).number<std::uint32_t>();
  constexpr std::array kMagics = {0xA1B2C3D4U, 0xD4C3B2A1U, 0xA1B23C4DU, 0x4D3CB2A1U, 0x0A0D0D0AU};
  return std::find(kMagics.begin(), kMagics.end(), word) != kMagics.end();
}

std::string extension_of(const fs::path& file) {
  std::string text = file.extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The files of a folder that are recordings of their own, by kind.
std::map<RecordingKind, std::vector<fs::path>> recordings_in(const fs::path& folder) {
  std::map<RecordingKind, std::vector<fs::path>> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (!entry.is_regular_file(ignored)) continue;
    const RecordingKind kind = recording_kind(entry.path());
    if (kind != RecordingKind::kUnknown && kind != RecordingKind::kFloatScans &&
        kind != RecordingKind::kClouds) {
      found[kind].push_back(entry.path());
    }
  }
  for (auto& [kind, files] : found) {
    std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
      return natural_less(a.filename().string(), b.filename().string());
    });
  }
  return found;
}

/// NAME-000.pcap, NAME-001.pcap: parts of one recording.
bool are_numbered(const std::vector<fs::path>& files) {
  const auto name = [](const fs::path& file) {
    const std::string stem = file.stem().string();
    const auto last = stem.find_last_not_of("0123456789");
    const bool numbered = last != std::string::npos && last + 1 < stem.size() &&
                          (stem[last] == '-' || stem[last] == '_');
    return numbered ? stem.substr(0, last + 1) : std::string();
  };
  const std::string first = name(files.front());
  return !first.empty() && std::all_of(files.begin(), files.end(),
                                       [&](const fs::path& file) { return name(file) == first; });
}

RecordingParts folder_parts(const fs::path& folder) {
  if (is_kitti_folder(folder)) return {RecordingKind::kFloatScans, {folder}};
  const auto found = recordings_in(folder);
  if (found.empty()) {
    if (!cloud_folder_in(folder).empty()) return {RecordingKind::kClouds, {folder}};
    return {};
  }
  if (found.size() > 1) {
    throw Error(folder.string() + ": recordings of several kinds in it, " +
                found.begin()->second.front().filename().string() + " and " +
                std::next(found.begin())->second.front().filename().string() + ": name the file");
  }
  const auto& [kind, files] = *found.begin();
  const bool parts = kind == RecordingKind::kRos1Bag || kind == RecordingKind::kMcap ||
                     kind == RecordingKind::kRos2Database ||
                     (kind == RecordingKind::kCapture && are_numbered(files));
  if (files.size() > 1 && !parts) {
    throw Error(folder.string() + ": " + std::to_string(files.size()) +
                " captures in it, expected one: name the file");
  }
  return {kind, files};
}

}  // namespace

namespace {

/// Of a file that is packed with zstd as a whole, the first bytes that it holds.
std::vector<std::uint8_t> first_unpacked(const fs::path& file) {
  constexpr std::size_t kFirstBlock = 1 << 18;  // a block of zstd, and more
  std::vector<std::uint8_t> held;
  (void)decompress(Compression::kZstd, first_bytes(file, kFirstBlock), kFirstBytes, held);
  return held;
}

}  // namespace

RecordingKind recording_kind(const fs::path& file) {
  const std::vector<std::uint8_t> begin =
      is_zstd(file) ? first_unpacked(file) : first_bytes(file, kFirstBytes);
  const std::string_view text = text_of(begin);
  const auto begins = [&](std::string_view magic) { return text.substr(0, magic.size()) == magic; };
  if (begins("#ROSBAG V2.0")) return RecordingKind::kRos1Bag;
  if (begins("\x89MCAP0\r\n")) return RecordingKind::kMcap;
  if (begins(std::string_view("SQLite format 3\0", 16))) return RecordingKind::kRos2Database;
  if (text.size() > kOsfMagicAt + 4 && text.substr(kOsfMagicAt, 4) == "OSF$") {
    return RecordingKind::kOsf;
  }
  const std::string extension = extension_of(file);
  if (is_capture(begin) || extension == ".pcap" || extension == ".pcapng") {
    return RecordingKind::kCapture;
  }
  if (cloud_format(begin) != CloudFormat::kNone) return RecordingKind::kClouds;
  return extension == ".bin" ? RecordingKind::kFloatScans : RecordingKind::kUnknown;
}

RecordingParts recording_parts(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return folder_parts(path);
  return {recording_kind(path), {path}};
}

}  // namespace saker::lidar
