#include "saker/lidar/osf/flat_table.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kMostTables = 1 << 20;

}  // namespace

FlatTable FlatTable::root(ByteView buffer, bool size_prefixed) {
  const FlatTable whole(buffer.subspan(std::min<std::size_t>(size_prefixed ? 4 : 0, buffer.size())),
                        0);
  return {whole.buffer_, whole.target(0)};
}

std::size_t FlatTable::position(std::size_t field) const {
  Cursor table(from(at_));
  const auto back = table.number<std::int32_t>();
  const auto vtable = static_cast<std::int64_t>(at_) - back;
  if (!table.ok() || vtable < 0) return 0;
  Cursor entries(from(static_cast<std::size_t>(vtable)));
  const auto size = entries.number<std::uint16_t>();
  if (4 + 2 * field + 2 > size) return 0;
  entries.skip(2 + 2 * field);
  const auto offset = entries.number<std::uint16_t>();
  return entries.ok() && offset != 0 ? at_ + offset : 0;
}

std::size_t FlatTable::target(std::size_t at) const {
  Cursor cursor(from(at));
  const auto offset = cursor.number<std::uint32_t>();
  return cursor.ok() ? std::min(at + offset, buffer_.size()) : buffer_.size();
}

ByteView FlatTable::bytes(std::size_t field, std::size_t element) const {
  const std::size_t at = position(field);
  if (at == 0) return {};
  Cursor cursor(from(target(at)));
  const std::size_t count = cursor.number<std::uint32_t>();
  return cursor.take(count * element);
}

std::vector<FlatTable> FlatTable::tables(std::size_t field) const {
  std::vector<FlatTable> all;
  const std::size_t at = position(field);
  if (at == 0) return all;
  const std::size_t vector = target(at);
  const std::size_t count = Cursor(from(vector)).number<std::uint32_t>();
  for (std::size_t i = 0; i < std::min(count, kMostTables); ++i) {
    const std::size_t element = vector + 4 + 4 * i;
    if (element + 4 > buffer_.size()) break;
    all.push_back({buffer_, target(element)});
  }
  return all;
}

}  // namespace saker::lidar
