#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace saker::flight {

/// Puts together what was sent in chunks, in whatever order they come: lost, twice, mixed with
/// those of the next one. Delivers in the order of time; what stays incomplete gives way to what is
/// newer.
///
/// `Message` has utime, sequence, chunk and num_chunks. Its caller has checked the chunk itself;
/// memory: two of them, of at most `Message::MAX_CHUNKS` chunks.
template <class Message>
class ChunkJoiner {
 public:
  struct Counters {
    long incomplete = 0;  ///< given up
    long late = 0;        ///< chunks of what was delivered or given up
    long repeated = 0;
    long refused = 0;  ///< chunks that contradict themselves or the others
  };

  /// All the chunks, in their order, when this one was the last that was missing.
  [[nodiscard]] std::optional<std::vector<Message>> add(Message chunk) {
    if (chunk.num_chunks < 1 || chunk.num_chunks > Message::MAX_CHUNKS || chunk.chunk < 0 ||
        chunk.chunk >= chunk.num_chunks) {
      ++counters_.refused;
      return std::nullopt;
    }
    Partial* const partial = partial_of(chunk);
    if (!partial || !put(*partial, std::move(chunk))) return std::nullopt;
    return finish(*partial);
  }

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  static constexpr std::size_t kMostPartials = 2;  // chunks of neighbours may be mixed
  static constexpr std::int64_t kRestartBack_us =
      1000000;  // older than this: the sender's clock restarted

  struct Partial {
    std::int64_t utime;
    std::int32_t sequence;
    int missing;
    std::vector<std::optional<Message>> chunks;
  };

  /// The partial that this chunk belongs to, a new one if need be; null when it is late.
  Partial* partial_of(const Message& chunk) {
    for (Partial& p : partials_) {
      if (p.utime == chunk.utime && p.sequence == chunk.sequence) return &p;
    }
    if (last_utime_ && *last_utime_ - chunk.utime > kRestartBack_us) {
      give_up(partials_.size());
      last_utime_.reset();
    }
    if (last_utime_ && chunk.utime <= *last_utime_) {
      ++counters_.late;
      return nullptr;
    }
    if (partials_.size() == kMostPartials) {
      last_utime_ =
          std::max(last_utime_.value_or(partials_.front().utime), partials_.front().utime);
      give_up(1);
    }
    partials_.push_back({chunk.utime, chunk.sequence, chunk.num_chunks, {}});
    partials_.back().chunks.resize(chunk.num_chunks);
    return &partials_.back();
  }

  bool put(Partial& partial, Message chunk) {
    if (chunk.num_chunks != static_cast<int>(partial.chunks.size())) {
      ++counters_.refused;
      return false;
    }
    std::optional<Message>& place = partial.chunks[chunk.chunk];
    if (place) {
      ++counters_.repeated;
      return false;
    }
    place = std::move(chunk);
    --partial.missing;
    return true;
  }

  std::optional<std::vector<Message>> finish(Partial& partial) {
    if (partial.missing > 0) return std::nullopt;
    std::vector<Message> whole;
    for (auto& chunk : partial.chunks) whole.push_back(std::move(*chunk));
    last_utime_ = partial.utime;
    const std::size_t before = partials_.size();
    std::erase_if(partials_, [&](const Partial& p) { return p.utime <= *last_utime_; });
    counters_.incomplete += static_cast<long>(before - partials_.size()) - 1;
    return whole;
  }

  void give_up(std::size_t oldest) {
    partials_.erase(partials_.begin(), partials_.begin() + static_cast<std::ptrdiff_t>(oldest));
    counters_.incomplete += static_cast<long>(oldest);
  }

  std::deque<Partial> partials_;  // in the order in which they began
  std::optional<std::int64_t> last_utime_;
  Counters counters_;
};

}  // namespace saker::flight
