#include "saker/lidar/bags/unpacked_file.h"

#include <unistd.h>
#include <zstd.h>

#include <memory>
#include <string>
#include <vector>

#include "saker/core/error.h"
#include "saker/lidar/cursor.h"
#include "saker/lidar/file_bytes.h"

namespace saker::lidar {
namespace {

constexpr std::uint32_t kZstdMagic = 0xFD2FB528;

std::filesystem::path made_file(int& descriptor) {
  std::string name = (std::filesystem::temp_directory_path() / "saker-unpacked-XXXXXX").string();
  descriptor = ::mkstemp(name.data());
  if (descriptor < 0) throw Error("cannot write " + name);
  return name;
}

void write_all(int descriptor, const std::uint8_t* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(descriptor, bytes, count);
    if (written <= 0) throw Error("cannot unpack into the temporary folder: no room");
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

/// \return whether the file was whole
bool unpack(const FileBytes& file, int descriptor) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          &ZSTD_freeDStream);
  std::vector<std::uint8_t> packed, piece(ZSTD_DStreamOutSize());
  std::size_t hint = 1;
  for (std::uint64_t at = 0; at < file.size(); at += packed.size()) {
    file.read(at, ZSTD_DStreamInSize(), packed);
    if (packed.empty()) return false;
    ZSTD_inBuffer in{packed.data(), packed.size(), 0};
    bool full = true;  // there may be more than fits the piece
    while (in.pos < in.size || full) {
      ZSTD_outBuffer out{piece.data(), piece.size(), 0};
      hint = ZSTD_decompressStream(stream.get(), &out, &in);
      if (ZSTD_isError(hint)) return false;
      write_all(descriptor, piece.data(), out.pos);
      full = out.pos == out.size;
    }
  }
  return hint == 0;
}

}  // namespace

bool is_zstd(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> begin = first_bytes(file, sizeof kZstdMagic);
  return Cursor(begin).number<std::uint32_t>() == kZstdMagic;
}

UnpackedFile::UnpackedFile(const std::filesystem::path& file) : path_(file) {
  if (!is_zstd(file)) return;
  const FileBytes packed(file);
  int descriptor = -1;
  path_ = made_file(descriptor);
  temporary_ = true;
  try {
    cut_ = !unpack(packed, descriptor);
  } catch (...) {
    ::close(descriptor);
    ::unlink(path_.c_str());
    throw;
  }
  ::close(descriptor);
}

UnpackedFile::~UnpackedFile() {
  if (temporary_) ::unlink(path_.c_str());
}

}  // namespace saker::lidar
