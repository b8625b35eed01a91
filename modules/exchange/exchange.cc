#include "saker/exchange/exchange.h"

#include <fmt/format.h>

#include <system_error>

#include "saker/core/error.h"

namespace saker::exchange {
namespace {

/// What LCM and exchange_t add to a datagram: header, channel, fingerprint, utime, count.
constexpr std::size_t kLcmBytes = 8 + 26 + 8 + 8 + 4;

std::filesystem::path made(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(fmt::format("cannot make {}: {}", folder.string(), error.message()));
  return folder;
}

void add(const Peer::Counters& one, Peer::Counters& sum) {
  sum.chunks_sent += one.chunks_sent;
  sum.chunks_received += one.chunks_received;
  sum.chunks_repeated += one.chunks_repeated;
  sum.malformed += one.malformed;
  sum.conflicts += one.conflicts;
  sum.refused += one.refused;
}

}  // namespace

Exchange::Exchange(const PeerConfig& config, const std::string& name, const Key& key,
                   const std::filesystem::path& folder, Store& store)
    : config_(core::checked(config, "exchange")),
      store_(store),
      sealer_(key, name, made(folder) / "sent.epoch"),
      opener_(key, name, folder / "heard.windows") {
  require_key_of(key, name);
}

void Exchange::add_link(const std::string& channel, Role role) {
  links_.try_emplace(channel, Link{"", Peer(config_, role, store_)});
}

Verdict Exchange::receive(Time now, const std::string& channel, std::string_view sealed) {
  counters_.received_bytes += static_cast<long>(sealed.size());
  ++counters_.received_datagrams;
  const Opened opened = opener_.open(channel, sealed);
  if (opened.verdict != Verdict::genuine) return opened.verdict;
  const auto found = links_.find(channel);
  if (found == links_.end()) {
    ++counters_.strangers;
    return opened.verdict;
  }
  Link& link = found->second;
  // One counterpart at a time: two would be taken for one that holds what either does.
  if (link.counterpart != opened.sender && link.peer.in_contact(now)) {
    ++counters_.strangers;
    return opened.verdict;
  }
  link.counterpart = opened.sender;
  link.peer.receive(now, opened.payload);
  return opened.verdict;
}

std::optional<Datagram> Exchange::next(Time now) {
  for (auto& [channel, link] : links_) {
    const auto message = link.peer.next(now, kSealBytes + kLcmBytes);
    if (!message) continue;
    auto sealed = sealer_.seal(channel, *message);
    if (!sealed) {
      ++counters_.unsealed;
      continue;
    }
    counters_.sent_bytes += static_cast<long>(sealed->size());
    ++counters_.sent_datagrams;
    return Datagram{channel, std::move(*sealed)};
  }
  return std::nullopt;
}

Exchange::Counters Exchange::counters() const {
  Counters all = counters_;
  for (const auto& [channel, link] : links_) add(link.peer.counters(), all.peers);
  return all;
}

std::vector<Exchange::Contact> Exchange::contacts(Time now) const {
  std::vector<Contact> all;
  for (const auto& [channel, link] : links_) {
    all.push_back({channel, link.counterpart, link.peer.heard(), link.peer.in_contact(now),
                   link.peer.all_sent(), link.peer.all_heard()});
  }
  return all;
}

std::vector<std::pair<std::string, long>> health(const Exchange& exchange) {
  const Exchange::Counters counters = exchange.counters();
  std::vector<std::pair<std::string, long>> figures = {
      {"exchange_sent_bytes", counters.sent_bytes},
      {"exchange_received_bytes", counters.received_bytes},
      {"exchange_strangers", counters.strangers},
      {"exchange_malformed", counters.peers.malformed},
      {"exchange_conflicts", counters.peers.conflicts},
      {"exchange_refused", counters.peers.refused}};
  const std::vector<std::string> verdicts = enum_names(Verdict{});
  for (const Verdict verdict :
       {Verdict::cut, Verdict::unknown, Verdict::forged, Verdict::replayed, Verdict::unkept}) {
    const long earlier =
        verdict == Verdict::replayed ? exchange.opener().count(Verdict::superseded) : 0;
    figures.emplace_back("exchange_" + verdicts[static_cast<std::size_t>(verdict)],
                         exchange.opener().count(verdict) + earlier);
  }
  return figures;
}

}  // namespace saker::exchange
