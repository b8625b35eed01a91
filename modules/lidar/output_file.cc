#include "lidar/output_file.h"

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace saker::lidar {

OutputFile::OutputFile(std::filesystem::path file)
    : file_(std::move(file)), part_(file_.string() + ".part") {
  out_ = std::fopen(part_.c_str(), "wb");
  if (out_ == nullptr) fail();
}

OutputFile::~OutputFile() {
  if (out_ == nullptr) return;
  std::fclose(out_);
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
  if (error) throw Error("cannot write " + file_.string() + ": " + error.message());
}

void OutputFile::fail() const {
  throw Error("cannot write " + file_.string() + ": " + std::strerror(errno));
}

}  // namespace saker::lidar
