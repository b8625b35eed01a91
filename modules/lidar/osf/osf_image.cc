#include "saker/lidar/osf/osf_image.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>

#include "saker/lidar/bags/decompress.h"

namespace saker::lidar {
namespace {

constexpr std::uint16_t kPackedMagic = 0xFBF8;
constexpr std::size_t kPackedHead = 8;

/// Of four bytes a pixel: planes of blue, green less blue, green less red, and the fourth; each
/// byte is the difference from its left neighbour.
void unfilter_planes(const std::vector<std::uint8_t>& planes, OsfImage& image) {
  const std::size_t count = image.rows * image.columns;
  for (std::size_t row = 0; row < image.rows; ++row) {
    std::uint8_t left[4] = {};
    for (std::size_t i = row * image.columns; i < (row + 1) * image.columns; ++i) {
      const auto second = static_cast<std::uint8_t>(planes[count + i] + planes[i]);
      const std::uint8_t steps[4] = {static_cast<std::uint8_t>(second - planes[2 * count + i]),
                                     second, planes[i], planes[3 * count + i]};
      for (std::size_t k = 0; k < 4; ++k) {
        left[k] = static_cast<std::uint8_t>(left[k] + steps[k]);
        image.pixels[4 * i + k] = left[k];
      }
    }
  }
}

/// Each byte is the difference from the same byte of its left neighbour.
void unfilter_bytes(const std::vector<std::uint8_t>& steps, OsfImage& image) {
  const std::size_t size = image.bytes_a_pixel, row_bytes = size * image.columns;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::uint8_t left = i % row_bytes < size ? 0 : image.pixels[i - size];
    image.pixels[i] = static_cast<std::uint8_t>(left + steps[i]);
  }
}

bool unpack_filtered(ByteView bytes, OsfImage& image) {
  Cursor head(bytes);
  head.skip(sizeof kPackedMagic);
  const std::size_t columns = head.number<std::uint16_t>(), rows = head.number<std::uint16_t>();
  const std::size_t channels = head.number<std::uint8_t>();
  image.bytes_a_pixel = channels * head.number<std::uint8_t>();
  if (!head.ok() || rows != image.rows || columns != image.columns) return false;
  const std::size_t size = image.bytes_a_pixel * rows * columns;
  if (image.bytes_a_pixel == 0 || image.bytes_a_pixel > 8) return false;
  std::vector<std::uint8_t> steps;
  if (!decompress(Compression::kZstd, bytes.subspan(kPackedHead), size + 1, steps)) return false;
  if (steps.size() != size) return false;
  image.pixels.resize(size);
  if (image.bytes_a_pixel == 4) {
    unfilter_planes(steps, image);
  } else {
    unfilter_bytes(steps, image);
  }
  return true;
}

/// libpng, its errors as a return value.
class PngReader {
 public:
  explicit PngReader(ByteView bytes)
      : bytes_(bytes),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, [](png_structp, auto) {})),
        info_(png_create_info_struct(png_)) {
    png_set_read_fn(png_, this, take);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// The bytes of a number are grey (8, 16 bits) or colours (24, 32, 64 bits), the lowest first.
  bool read(OsfImage& image) {
    if (setjmp(failed_) != 0) return false;
    png_read_info(png_, info_);
    const std::size_t row_bytes = png_get_rowbytes(png_, info_);
    if (png_get_image_width(png_, info_) != image.columns ||
        png_get_image_height(png_, info_) != image.rows ||
        png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE ||
        row_bytes % image.columns != 0 || row_bytes > 8 * image.columns) {
      return false;
    }
    image.bytes_a_pixel = row_bytes / image.columns;
    image.pixels.resize(row_bytes * image.rows);
    for (std::size_t row = 0; row < image.rows; ++row) {
      png_read_row(png_, image.pixels.data() + row * row_bytes, nullptr);
    }
    image.destaggered = true;
    return true;
  }

 private:
  [[noreturn]] static void fail(png_structp png, png_const_charp) {
    std::longjmp(static_cast<PngReader*>(png_get_error_ptr(png))->failed_, 1);
  }
  static void take(png_structp png, png_bytep into, std::size_t count) {
    auto& self = *static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > self.bytes_.size()) png_error(png, "cut");
    std::copy_n(self.bytes_.begin(), count, into);
    self.bytes_ = self.bytes_.subspan(count);
  }

  ByteView bytes_;
  std::jmp_buf failed_ = {};
  png_structp png_;
  png_infop info_;
};

}  // namespace

std::uint64_t OsfImage::pixel(std::size_t row, std::size_t column) const {
  std::uint64_t value = 0;
  const std::size_t at = (row * columns + column) * bytes_a_pixel;
  for (std::size_t k = 0; k < bytes_a_pixel; ++k) {
    value |= std::uint64_t{pixels[at + k]} << (8 * k);
  }
  return value;
}

bool unpack_osf_image(ByteView bytes, std::size_t rows, std::size_t columns, OsfImage& image) {
  image = {};
  image.rows = rows;
  image.columns = columns;
  if (Cursor(bytes).number<std::uint16_t>() == kPackedMagic) return unpack_filtered(bytes, image);
  if (bytes.size() > 8 && png_sig_cmp(bytes.data(), 0, 8) == 0) return PngReader(bytes).read(image);
  return false;
}

}  // namespace saker::lidar
