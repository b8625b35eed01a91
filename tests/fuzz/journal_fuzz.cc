#include <fstream>

#include "fuzz.h"
#include "saker/exchange/bytes.h"
#include "saker/exchange/journal_store.h"

/// A robot's journal of streams. The first byte says whether the rest is the file, or records, each
/// behind two bytes of its length, which are given the check sum that a whole record has.
namespace saker {
namespace {

/// Of a record: journal_store.cc.
std::uint32_t check_sum(std::string_view bytes) {
  std::uint32_t sum = 1, sums = 0;
  for (const char byte : bytes) {
    sum = (sum + static_cast<std::uint8_t>(byte)) % 65521;
    sums = (sums + sum) % 65521;
  }
  return sums << 16 | sum;
}

std::string journal_of(lidar::Cursor& records) {
  exchange::ByteWriter out;
  out.raw("SAKERSTREAMS1\n");
  while (records.left() > 0) {
    const auto body = lidar::text_of(records.take_at_most(records.number<std::uint16_t>()));
    out.text(body);
    out.fixed(check_sum(body));
  }
  return out.bytes();
}

}  // namespace

void lidar::fuzz::run(ByteView input) {
  Cursor cursor(input);
  const bool as_it_is = cursor.number<std::uint8_t>() % 2 == 0;
  const std::string journal =
      as_it_is ? std::string(text_of(cursor.take_at_most(input.size()))) : journal_of(cursor);
  const exchange::JournalStore store(file_of(bytes_of(journal), ".journal"));
  for (const auto& [id, extent] : store.extents()) {
    expect(exchange::is_name(id.robot) && store.bytes(id).size() == extent.contiguous);
  }
}

}  // namespace saker
