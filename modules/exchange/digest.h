#pragma once

#include <sodium.h>

#include <cstdint>

#include "saker/exchange/store.h"

namespace saker::exchange {

/// Of the first bytes of a stream: tells whether two ends hold the same. BLAKE2b cut to 32 bits;
/// asking for longer and longer beginnings reads every chunk once.
class PrefixDigest {
 public:
  /// \param bytes  at most what the store holds without a gap
  [[nodiscard]] std::uint32_t of(const Store& store, const StreamId& id, std::size_t bytes);

 private:
  crypto_generichash_state state_{};
  std::size_t bytes_ = 0;  // that are in state_
  bool begun_ = false;
};

}  // namespace saker::exchange
