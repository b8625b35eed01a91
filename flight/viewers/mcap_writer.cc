#include "flight/viewers/mcap_writer.h"

#include <zstd.h>

#include <algorithm>

#include "saker/core/error.h"
#include "saker/objects/checksum.h"

namespace saker::flight::viewers {
namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
constexpr std::size_t kChunk = std::size_t{1} << 20;
constexpr std::uint16_t kMostChannels = 65535;

enum Op : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunkRecord = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kStatistics = 11,
  kSummaryOffset = 14,
  kDataEnd = 15,
};

template <class Number>
void add(std::string& bytes, Number value) {
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff);
}

void add_text(std::string& bytes, std::string_view text) {
  add(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

std::string record(Op op, std::string_view content) {
  std::string bytes(1, static_cast<char>(op));
  add(bytes, static_cast<std::uint64_t>(content.size()));
  bytes += content;
  return bytes;
}

std::string compressed(const std::string& bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3);
  if (ZSTD_isError(size) != 0) throw Error(std::string("zstd: ") + ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& file) : out_(file) {
  put(kMagic);
  std::string header;
  add_text(header, "");  // no profile
  add_text(header, "saker");
  put(record(kHeader, header));
}

void McapWriter::put(std::string_view bytes) {
  if (broken_) throw Error("a recording that broke off is not finished");
  broken_ = true;  // until it is written
  out_.write(bytes);
  broken_ = false;
  at_ += bytes.size();
}

std::uint16_t McapWriter::add(const Channel& channel) {
  if (counts_.size() == kMostChannels) throw Error("an MCAP file has at most 65535 channels");
  const std::string key =
      channel.schema_encoding + '\n' + channel.schema_name + '\n' + channel.schema;
  const auto next_schema = static_cast<std::uint16_t>(schema_ids_.size() + 1);
  const auto [schema, is_new] = schema_ids_.try_emplace(key, next_schema);
  if (is_new) {
    std::string content;
    viewers::add(content, schema->second);
    add_text(content, channel.schema_name);
    add_text(content, channel.schema_encoding);
    add_text(content, channel.schema);
    const std::string bytes = record(kSchema, content);
    fresh_ += bytes;
    schemas_ += bytes;
  }
  const auto id = static_cast<std::uint16_t>(counts_.size() + 1);
  counts_[id] = 0;
  std::string content;
  viewers::add(content, id);
  viewers::add(content, schema->second);
  add_text(content, channel.topic);
  add_text(content, channel.encoding);
  viewers::add(content, std::uint32_t{0});  // bytes of metadata
  const std::string bytes = record(kChannel, content);
  fresh_ += bytes;
  channels_ += bytes;
  return id;
}

void McapWriter::write(std::uint16_t channel, Time time, std::string_view bytes) {
  const Time stamp = std::max<Time>(time, 0);
  chunk_.records += fresh_;
  fresh_.clear();
  const bool first = chunk_.index.empty();
  chunk_.begin = first ? stamp : std::min(chunk_.begin, stamp);
  chunk_.end = first ? stamp : std::max(chunk_.end, stamp);
  begin_ = messages_ == 0 ? stamp : std::min(begin_, stamp);
  end_ = messages_ == 0 ? stamp : std::max(end_, stamp);
  chunk_.index[channel].emplace_back(stamp, chunk_.records.size());
  std::string content;
  content.reserve(bytes.size() + 22);
  viewers::add(content, channel);
  viewers::add(content, sequences_[channel]++);
  viewers::add(content, static_cast<std::uint64_t>(stamp));
  viewers::add(content, static_cast<std::uint64_t>(stamp));
  content += bytes;
  chunk_.records += record(kMessage, content);
  ++messages_;
  ++counts_.at(channel);
  if (chunk_.records.size() >= kChunk) close_chunk();
}

void McapWriter::close_chunk() {
  chunk_.records += fresh_;
  fresh_.clear();
  if (chunk_.records.empty()) return;
  const std::string packed = compressed(chunk_.records);
  std::string content;
  viewers::add(content, static_cast<std::uint64_t>(chunk_.begin));
  viewers::add(content, static_cast<std::uint64_t>(chunk_.end));
  viewers::add(content, static_cast<std::uint64_t>(chunk_.records.size()));
  viewers::add(content, objects::checksum(chunk_.records));
  add_text(content, "zstd");
  viewers::add(content, static_cast<std::uint64_t>(packed.size()));
  content += packed;
  const std::uint64_t chunk_at = at_;
  put(record(kChunkRecord, content));
  const std::uint64_t index_at = at_;
  std::string offsets;
  for (const auto& [channel, entries] : chunk_.index) {
    viewers::add(offsets, channel);
    viewers::add(offsets, at_);
    std::string index;
    viewers::add(index, channel);
    viewers::add(index, static_cast<std::uint32_t>(16 * entries.size()));
    for (const auto& [stamp, offset] : entries) {
      viewers::add(index, stamp);
      viewers::add(index, offset);
    }
    put(record(kMessageIndex, index));
  }
  std::string index;
  viewers::add(index, static_cast<std::uint64_t>(chunk_.begin));
  viewers::add(index, static_cast<std::uint64_t>(chunk_.end));
  viewers::add(index, chunk_at);
  viewers::add(index, index_at - chunk_at);
  add_text(index, offsets);
  viewers::add(index, at_ - index_at);
  add_text(index, "zstd");
  viewers::add(index, static_cast<std::uint64_t>(packed.size()));
  viewers::add(index, static_cast<std::uint64_t>(chunk_.records.size()));
  chunk_indices_ += record(kChunkIndex, index);
  ++chunks_;
  chunk_ = Chunk();
}

std::string McapWriter::statistics() const {
  std::string content;
  viewers::add(content, messages_);
  viewers::add(content, static_cast<std::uint16_t>(schema_ids_.size()));
  viewers::add(content, static_cast<std::uint32_t>(counts_.size()));
  viewers::add(content, std::uint32_t{0});  // attachments
  viewers::add(content, std::uint32_t{0});  // metadata
  viewers::add(content, chunks_);
  viewers::add(content, static_cast<std::uint64_t>(begin_));
  viewers::add(content, static_cast<std::uint64_t>(end_));
  viewers::add(content, static_cast<std::uint32_t>(10 * counts_.size()));
  for (const auto& [channel, count] : counts_) {
    viewers::add(content, channel);
    viewers::add(content, count);
  }
  return record(kStatistics, content);
}

void McapWriter::finish() {
  close_chunk();
  put(record(kDataEnd, std::string(4, '\0')));  // no checksum of the data
  const std::uint64_t summary_at = at_;
  std::string summary, offsets;
  const auto add_group = [&](Op op, const std::string& records) {
    if (records.empty()) return;
    std::string content(1, static_cast<char>(op));
    viewers::add(content, summary_at + summary.size());
    viewers::add(content, static_cast<std::uint64_t>(records.size()));
    offsets += record(kSummaryOffset, content);
    summary += records;
  };
  add_group(kSchema, schemas_);
  add_group(kChannel, channels_);
  add_group(kStatistics, statistics());
  add_group(kChunkIndex, chunk_indices_);
  const std::uint64_t offsets_at = summary_at + summary.size();
  summary += offsets;
  std::string footer;
  viewers::add(footer, summary_at);
  viewers::add(footer, offsets_at);
  viewers::add(footer, std::uint32_t{0});
  summary += record(kFooter, footer);
  summary.resize(summary.size() - 4);
  const std::uint32_t checksum = objects::checksum(summary);
  viewers::add(summary, checksum);
  put(summary);
  put(kMagic);
  out_.finish();
}

}  // namespace saker::flight::viewers
