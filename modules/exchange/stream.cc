#include "saker/exchange/stream.h"

#include <fmt/format.h>

#include <algorithm>

namespace saker::exchange {

std::vector<std::string> enum_names(StreamKind) { return {"history", "prior_map", "uncertainty"}; }

std::string to_string(const StreamId& id) {
  return fmt::format("{}/{}/{}", id.robot,
                     enum_names(id.kind).at(static_cast<std::size_t>(id.kind)), id.version);
}

bool is_name(const std::string& name) {
  const auto allowed = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
  return !name.empty() && name.size() <= kLongestName &&
         std::all_of(name.begin(), name.end(), allowed);
}

std::size_t Extent::bytes_of(int chunk) const {
  if (chunk < open_chunk()) return kChunkBytes;
  if (chunk == open_chunk()) return contiguous % kChunkBytes;
  const auto found = beyond.find(chunk);
  return found == beyond.end() ? 0 : found->second;
}

void Extent::add(int chunk, std::size_t bytes) {
  if (bytes <= bytes_of(chunk)) return;
  if (chunk > open_chunk()) {
    beyond[chunk] = bytes;
    return;
  }
  contiguous = static_cast<std::size_t>(chunk) * kChunkBytes + bytes;
  // The gap is closed: what lies right behind it belongs to the beginning now.
  while (contiguous % kChunkBytes == 0 && !beyond.empty() &&
         beyond.begin()->first == open_chunk()) {
    contiguous += beyond.begin()->second;
    beyond.erase(beyond.begin());
  }
}

void Extent::merge(const Extent& other) {
  if (other.contiguous > contiguous) {
    contiguous = other.contiguous;
    beyond.erase(beyond.begin(), beyond.lower_bound(open_chunk()));
    if (const auto here = beyond.find(open_chunk()); here != beyond.end()) {
      const auto [chunk, bytes] = *here;
      beyond.erase(here);
      add(chunk, bytes);
    }
  }
  for (const auto& [chunk, bytes] : other.beyond) add(chunk, bytes);
}

}  // namespace saker::exchange
