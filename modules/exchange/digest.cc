#include "saker/exchange/digest.h"

#include <algorithm>
#include <array>

namespace saker::exchange {

std::uint32_t PrefixDigest::of(const Store& store, const StreamId& id, std::size_t bytes) {
  if (!begun_ || bytes < bytes_) {
    crypto_generichash_init(&state_, nullptr, 0, crypto_generichash_BYTES);
    bytes_ = 0;
    begun_ = true;
  }
  while (bytes_ < bytes) {
    const std::string chunk = store.chunk(id, static_cast<int>(bytes_ / kChunkBytes));
    const std::size_t from = bytes_ % kChunkBytes;
    const std::size_t end = std::min(chunk.size(), from + bytes - bytes_);
    if (end <= from) break;  // what cannot be read gives another digest
    crypto_generichash_update(&state_, reinterpret_cast<const unsigned char*>(&chunk[from]),
                              end - from);
    bytes_ += end - from;
  }
  crypto_generichash_state finished = state_;
  std::array<unsigned char, crypto_generichash_BYTES> digest{};
  crypto_generichash_final(&finished, digest.data(), digest.size());
  std::uint32_t word = 0;
  for (int i = 0; i < 4; ++i) word |= static_cast<std::uint32_t>(digest[i]) << (8 * i);
  return word;
}

}  // namespace saker::exchange
