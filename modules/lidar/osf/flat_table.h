#pragma once

#include <string>
#include <vector>

#include "saker/lidar/cursor.h"

namespace saker::lidar {

/// A table of FlatBuffers ("FlatBuffer Internals" of flatbuffers.dev), read in place. Whatever does
/// not lie inside the buffer counts as absent.
class FlatTable {
 public:
  FlatTable() = default;

  /// The root of a buffer; `size_prefixed`: behind four bytes of its length.
  [[nodiscard]] static FlatTable root(ByteView buffer, bool size_prefixed);

  template <class T>
  [[nodiscard]] T number(std::size_t field, T otherwise) const {
    const std::size_t at = position(field);
    Cursor cursor(from(at));
    const T value = cursor.number<T>();
    return at != 0 && cursor.ok() ? value : otherwise;
  }

  /// Strings, and vectors of numbers or structs of that many bytes.
  [[nodiscard]] ByteView bytes(std::size_t field, std::size_t element = 1) const;
  [[nodiscard]] std::vector<FlatTable> tables(std::size_t field) const;

 private:
  FlatTable(ByteView buffer, std::size_t at) : buffer_(buffer), at_(at) {}

  [[nodiscard]] ByteView from(std::size_t at) const {
    return buffer_.subspan(std::min(at, buffer_.size()));
  }
  [[nodiscard]] std::size_t position(std::size_t field) const;  // 0: absent
  [[nodiscard]] std::size_t target(std::size_t at) const;       // of an offset that stands there

  ByteView buffer_;
  std::size_t at_ = 0;
};

}  // namespace saker::lidar
