#include "saker/exchange/journal_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/exchange/bytes.h"
#include "saker/exchange/durable.h"

namespace saker::exchange {
namespace {

constexpr std::string_view kMagic = "SAKERSTREAMS1\n";

/// One record: stream, place, bytes, and their check sum, which tells where a sudden end cut.
struct Record {
  StreamId id;
  std::uint64_t chunk = 0, from = 0;
  std::string_view bytes;
};

/// Fletcher's, 32 bits (RFC 1146's algorithm on bytes): against cuts, not against people.
std::uint32_t check_sum(std::string_view bytes) {
  std::uint32_t sum = 1, sums = 0;
  for (const char byte : bytes) {
    sum = (sum + static_cast<std::uint8_t>(byte)) % 65521;
    sums = (sums + sum) % 65521;
  }
  return sums << 16 | sum;
}

std::string to_bytes(const Record& record) {
  ByteWriter body;
  body.text(record.id.robot);
  body.byte(static_cast<std::uint8_t>(record.id.kind));
  body.varint(record.id.version);
  body.varint(record.chunk);
  body.varint(record.from);
  body.text(record.bytes);
  ByteWriter out;
  out.text(body.bytes());
  out.fixed(check_sum(body.bytes()));
  return out.bytes();
}

/// False where there is no whole record.
bool read(ByteReader& in, Record& record) {
  const std::string_view whole = in.text();
  const auto sum = in.fixed<std::uint32_t>();
  if (in.failed() || sum != check_sum(whole)) return false;
  ByteReader body(whole);
  record.id.robot = body.text();
  const int kind = body.byte();
  record.id.kind = static_cast<StreamKind>(kind);
  record.id.version = static_cast<std::uint32_t>(body.varint());
  record.chunk = body.varint();
  record.from = body.varint();
  record.bytes = body.text();
  return body.done() && kind < kStreamKinds && is_name(record.id.robot) &&
         record.chunk < kMostChunks && record.from <= kChunkBytes && !record.bytes.empty() &&
         record.from + record.bytes.size() <= kChunkBytes;
}

/// Whether its bytes begin where those before it end.
bool follows(const Record& record, const Store& store) {
  const auto known = store.extents().find(record.id);
  const auto chunk = static_cast<int>(record.chunk);
  return record.from == (known == store.extents().end() ? 0 : known->second.bytes_of(chunk));
}

}  // namespace

JournalStore::JournalStore(const std::filesystem::path& file) {
  file_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file_ < 0) {
    throw Error(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
  }
  const std::string journal = core::read_file(file);
  if (journal.size() > kMagic.size() ? !journal.starts_with(kMagic)
                                     : !kMagic.starts_with(journal)) {
    throw Error(fmt::format("{}: not a journal of streams", file.string()));
  }
  if (journal.size() < kMagic.size() && !write_at(file_, kMagic, 0)) {
    throw Error(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
  }
  size_ = kMagic.size();
  if (journal.size() > kMagic.size()) read_back(journal);
}

JournalStore::~JournalStore() { ::close(file_); }

void JournalStore::read_back(const std::string& journal) {
  ByteReader in(std::string_view(journal).substr(kMagic.size()));
  Record record;
  while (in.rest() > 0 && read(in, record) && follows(record, *this)) {
    (void)MemoryStore::keep(record.id, static_cast<int>(record.chunk), record.from, record.bytes);
    restore(record.id, static_cast<int>(record.chunk), record.from + record.bytes.size());
    size_ = kMagic.size() + in.at();
  }
}

/// Written behind the last whole record, over what an earlier failure left there; synced before it
/// counts, since the counterpart will not send it again.
bool JournalStore::keep(const StreamId& id, int chunk, std::size_t from, std::string_view bytes) {
  const std::string record = to_bytes({id, static_cast<std::uint64_t>(chunk), from, bytes});
  if (!write_at(file_, record, size_) || ::fdatasync(file_) != 0) return false;
  size_ += record.size();
  return MemoryStore::keep(id, chunk, from, bytes);
}

}  // namespace saker::exchange
