#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string_view>

namespace saker::lidar {

/// A file that appears under its name only when it is whole: written as NAME.part and renamed.
/// Throws Error that names the file when it cannot be written; what was not finished is removed.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  void write(std::span<const std::uint8_t> bytes);
  void finish();

 private:
  void write_bytes(const void* data, std::size_t size);
  [[noreturn]] void fail() const;

  std::filesystem::path file_;
  std::filesystem::path part_;
  std::FILE* out_ = nullptr;
};

}  // namespace saker::lidar
