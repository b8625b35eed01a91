#include "saker/lidar/bags/decompress.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <memory>

namespace saker::lidar {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;
constexpr std::size_t kMostOfOneLzfByte = 88;  // three of them repeat 264 at most
constexpr std::size_t kRoomToEnd = 64;         // decompressors want some to see that they are done

/// Grows `into` by a piece, at most to `most` bytes. \return bytes that may be written
std::size_t grow(std::vector<std::uint8_t>& into, std::size_t used, std::size_t most) {
  const std::size_t wanted = std::max(kPiece, used);  // doubles
  into.resize(std::min(most, used + wanted));
  return into.size() - used;
}

bool lz4(ByteView bytes, std::size_t most, std::vector<std::uint8_t>& into) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION))) return false;
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, &LZ4F_freeDecompressionContext);
  std::size_t used = 0, hint = 1;
  while (hint != 0) {
    std::size_t room = grow(into, used, most), size = bytes.size();
    if (room == 0) break;
    hint = LZ4F_decompress(context.get(), into.data() + used, &room, bytes.data(), &size, nullptr);
    if (LZ4F_isError(hint)) break;
    used += room;
    bytes = bytes.subspan(size);
    if (room == 0 && size == 0) break;  // more is wanted than there is
  }
  into.resize(used);
  return hint == 0;
}

bool zstd(ByteView bytes, std::size_t most, std::vector<std::uint8_t>& into) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          &ZSTD_freeDStream);
  if (!stream) return false;
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  std::size_t used = 0, hint = 1;
  while (hint != 0) {
    const std::size_t room = grow(into, used, most), read = in.pos;
    if (room == 0) break;
    ZSTD_outBuffer out{into.data() + used, room, 0};
    hint = ZSTD_decompressStream(stream.get(), &out, &in);
    if (ZSTD_isError(hint)) break;
    used += out.pos;
    if (out.pos == 0 && in.pos == read) break;
  }
  into.resize(used);
  return hint == 0;
}

bool bz2(ByteView bytes, std::size_t most, std::vector<std::uint8_t>& into) {
  bz_stream stream = {};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return false;
  // The library takes what it reads as not const, but does not write it.
  stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(bytes.data()));
  stream.avail_in = static_cast<unsigned>(bytes.size());
  std::size_t used = 0;
  int status = BZ_OK;
  while (status == BZ_OK) {
    const std::size_t room = grow(into, used, most);
    if (room == 0) break;
    const unsigned unread = stream.avail_in;
    stream.next_out = reinterpret_cast<char*>(into.data() + used);
    stream.avail_out = static_cast<unsigned>(room);
    status = BZ2_bzDecompress(&stream);
    const std::size_t written = room - stream.avail_out;
    used += written;
    if (written == 0 && stream.avail_in == unread) break;
  }
  BZ2_bzDecompressEnd(&stream);
  into.resize(used);
  return status == BZ_STREAM_END;
}

}  // namespace

Compression compression_of(std::string_view name) {
  if (name.empty() || name == "none") return Compression::kNone;
  if (name == "lz4") return Compression::kLz4;
  if (name == "zstd") return Compression::kZstd;
  if (name == "bz2") return Compression::kBz2;
  return Compression::kUnknown;
}

bool decompress(Compression compression, ByteView bytes, std::size_t most,
                std::vector<std::uint8_t>& into) {
  into.clear();
  const std::size_t room = most + kRoomToEnd;
  bool whole = false;
  switch (compression) {
    case Compression::kNone:
      into.assign(bytes.begin(),
                  bytes.begin() + static_cast<std::ptrdiff_t>(std::min(most, bytes.size())));
      return bytes.size() <= most;
    case Compression::kLz4:
      whole = lz4(bytes, room, into);
      break;
    case Compression::kZstd:
      whole = zstd(bytes, room, into);
      break;
    case Compression::kBz2:
      whole = bz2(bytes, room, into);
      break;
    case Compression::kUnknown:
      break;
  }
  return whole && into.size() <= most;
}

bool decompress_lzf(ByteView bytes, std::size_t size, std::vector<std::uint8_t>& into) {
  into.clear();
  if (size / kMostOfOneLzfByte > bytes.size()) return false;
  into.reserve(size);
  Cursor in(bytes);
  while (in.left() > 0) {
    const unsigned control = in.number<std::uint8_t>();
    if (control < 32) {  // so many bytes, and one, as they are
      const ByteView literal = in.take(control + 1);
      into.insert(into.end(), literal.begin(), literal.end());
    } else {  // bytes that were there before
      std::size_t count = control >> 5;
      if (count == 7) count += in.number<std::uint8_t>();
      const std::size_t back = ((control & 31) << 8) + in.number<std::uint8_t>() + 1;
      if (back > into.size()) return false;
      for (std::size_t i = 0; i < count + 2; ++i) into.push_back(into[into.size() - back]);
    }
    if (!in.ok() || into.size() > size) return false;
  }
  return into.size() == size;
}

}  // namespace saker::lidar
