#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

/// Files, whole or not at all: what is written appears under its name only when it is complete
/// (NAME.part, then renamed). Every failure is an Error that names the file and the system's cause.
namespace saker::core {

[[nodiscard]] std::string read_file(const std::filesystem::path& file);

void write_file(const std::filesystem::path& file, std::string_view content);

/// NumPy's format 1.0, rows × columns, row-major, little-endian.
void write_npy(const std::filesystem::path& file, std::span<const std::uint32_t> values, int rows,
               int columns);
void write_npy(const std::filesystem::path& file, std::span<const float> values, int rows,
               int columns);

/// For files that are written piece by piece. Without `finish` nothing is left behind.
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

}  // namespace saker::core
