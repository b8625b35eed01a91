#include "saker/exchange/store.h"

#include <algorithm>

namespace saker::exchange {

std::size_t Store::size(const StreamId& id) const {
  const auto found = extents_.find(id);
  return found == extents_.end() ? 0 : found->second.contiguous;
}

Kept Store::put(const StreamId& id, std::size_t offset, std::string_view bytes) {
  const std::size_t number = offset / kChunkBytes, from = offset % kChunkBytes;
  const auto known = extents_.find(id);
  const bool room = known != extents_.end() || extents_.size() < kMostStreams;
  if (!room || !is_name(id.robot) || number >= kMostChunks || from + bytes.size() > kChunkBytes) {
    return Kept::refused;
  }
  const int chunk = static_cast<int>(number);
  const std::size_t held = known == extents_.end() ? 0 : known->second.bytes_of(chunk);
  if (from + bytes.size() <= held) return Kept::repeated;
  if (from > held) return Kept::gap;
  if (!keep(id, chunk, held, bytes.substr(held - from))) return Kept::failed;
  extents_[id].add(chunk, from + bytes.size());
  return Kept::stored;
}

bool Store::append(const StreamId& id, std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t end = size(id);
    const std::size_t count = std::min(bytes.size(), kChunkBytes - end % kChunkBytes);
    if (put(id, end, bytes.substr(0, count)) != Kept::stored) return false;
    bytes.remove_prefix(count);
  }
  return true;
}

std::string Store::chunk(const StreamId& id, int chunk) const {
  const auto found = extents_.find(id);
  return found == extents_.end() || found->second.bytes_of(chunk) == 0 ? "" : load(id, chunk);
}

std::string Store::bytes(const StreamId& id) const {
  const std::size_t end = size(id);
  std::string all;
  for (int k = 0; all.size() < end; ++k) {
    const std::string part = chunk(id, k);
    if (part.empty()) break;
    all += part;
  }
  return all;
}

bool MemoryStore::keep(const StreamId& id, int chunk, std::size_t from, std::string_view bytes) {
  std::string& kept = chunks_[id][chunk];
  kept.resize(from);
  kept += bytes;
  return true;
}

std::string MemoryStore::load(const StreamId& id, int chunk) const {
  const auto stream = chunks_.find(id);
  if (stream == chunks_.end()) return "";
  const auto found = stream->second.find(chunk);
  return found == stream->second.end() ? "" : found->second;
}

std::uint32_t newest_version(const Store& store, const std::string& robot, StreamKind kind) {
  std::uint32_t newest = 0;
  for (const auto& [id, extent] : store.extents()) {
    if (id.robot == robot && id.kind == kind) newest = std::max(newest, id.version);
  }
  return newest;
}

std::uint32_t publish(Store& store, const std::string& robot, StreamKind kind,
                      std::string_view bytes) {
  const std::uint32_t newest = newest_version(store, robot, kind);
  if (newest > 0 && store.bytes({robot, kind, newest}) == bytes) return newest;
  return store.append({robot, kind, newest + 1}, bytes) ? newest + 1 : 0;
}

}  // namespace saker::exchange
