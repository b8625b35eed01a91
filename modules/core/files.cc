#include "saker/core/files.h"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "saker/core/error.h"

namespace saker::core {
namespace {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

/// Length of the magic, version and header of an .npy file is a multiple of this.
constexpr std::size_t kNpyAlignment = 64;

std::string npy_header(const char* type, int rows, int columns) {
  std::string dictionary = fmt::format(
      "{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}), }}", type, rows, columns);
  const std::size_t prefix = 10;  // magic, version, length
  const std::size_t used = prefix + dictionary.size() + 1;
  dictionary.append((kNpyAlignment - used % kNpyAlignment) % kNpyAlignment, ' ');
  dictionary += '\n';
  const auto length = static_cast<std::uint16_t>(dictionary.size());
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(length & 0xFF);
  header += static_cast<char>(length >> 8);
  return header + dictionary;
}

template <class T>
void write_npy_of(const std::filesystem::path& file, const char* type, std::span<const T> values,
                  int rows, int columns) {
  OutputFile out(file);
  out.write(npy_header(type, rows, columns));
  out.write(std::string_view(reinterpret_cast<const char*>(values.data()), values.size_bytes()));
  out.finish();
}

}  // namespace

std::string read_file(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) {
    throw Error(fmt::format("cannot read {}: it is a folder", file.string()));
  }
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  if (in && in.peek() != std::ifstream::traits_type::eof()) content << in.rdbuf();
  if (!in.is_open() || in.bad() || content.fail()) {
    throw Error(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)));
  }
  return std::move(content).str();
}

void write_file(const std::filesystem::path& file, std::string_view content) {
  OutputFile out(file);
  out.write(content);
  out.finish();
}

void write_npy(const std::filesystem::path& file, std::span<const std::uint32_t> values, int rows,
               int columns) {
  write_npy_of(file, "<u4", values, rows, columns);
}

void write_npy(const std::filesystem::path& file, std::span<const float> values, int rows,
               int columns) {
  write_npy_of(file, "<f4", values, rows, columns);
}

OutputFile::OutputFile(std::filesystem::path file)
    : file_(std::move(file)), part_(file_.string() + ".part") {
  out_ = std::fopen(part_.c_str(), "wb");
  if (out_ == nullptr) fail();
}

OutputFile::~OutputFile() {
  if (out_ != nullptr) std::fclose(out_);
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void OutputFile::write(std::string_view text) { write_bytes(text.data(), text.size()); }

void OutputFile::write(std::span<const std::uint8_t> bytes) {
  write_bytes(bytes.data(), bytes.size());
}

void OutputFile::write_bytes(const void* data, std::size_t size) {
  if (size > 0 && std::fwrite(data, 1, size, out_) != size) fail();
}

void OutputFile::finish() {
  std::FILE* out = out_;
  out_ = nullptr;
  if (std::fclose(out) != 0) fail();
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) throw Error(fmt::format("cannot write {}: {}", file_.string(), error.message()));
}

void OutputFile::fail() const {
  throw Error(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
}

}  // namespace saker::core
