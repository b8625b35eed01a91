#include "saker/exchange/seal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/exchange/bytes.h"
#include "saker/exchange/durable.h"

namespace saker::exchange {
namespace {

constexpr std::uint8_t kVersion = 2;
constexpr std::size_t kTag = crypto_aead_xchacha20poly1305_ietf_ABYTES;
constexpr std::size_t kNonce = crypto_aead_xchacha20poly1305_ietf_NPUBBYTES;
constexpr std::size_t kLife = 8 + 8;  // epoch and counter
static_assert(kTag == 16 && kNonce == 24);
constexpr int kDrawnBits = 22;  // of an epoch: 2^42 ms are 139 years

unsigned char* raw(std::string& bytes) { return reinterpret_cast<unsigned char*>(bytes.data()); }
const unsigned char* raw(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

/// "R1_COMMAND" → "R1".
std::string robot_of(const std::string& channel) { return channel.substr(0, channel.find('_')); }

/// What is authenticated beside the payload. The channel's length keeps the two apart.
std::string associated(const std::string& channel, std::string_view header) {
  ByteWriter out;
  out.text(channel);
  out.raw(header);
  return out.bytes();
}

void start_sodium() {
  if (sodium_init() < 0) throw Error("libsodium does not start: no source of random numbers");
}

void check_name(const std::string& name) {
  if (is_name(name)) return;
  throw Error(fmt::format("sender {}, expected up to {} capitals and digits", name, kLongestName));
}

[[noreturn]] void cannot_write(const std::filesystem::path& file) {
  throw Error(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
}

std::int64_t system_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

/// The newest epoch of this sender; 0 where none is kept.
std::uint64_t kept_epoch(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return 0;
  const std::string kept = core::read_file(file);
  ByteReader in(kept);
  const auto epoch = in.fixed<std::uint64_t>();
  if (in.done()) return epoch;
  throw Error(fmt::format("{}: {} bytes, expected the 8 of an epoch", file.string(), kept.size()));
}

/// Which of a robot's keys it is, without telling the key.
std::uint64_t number_of(const Key& key) {
  std::array<unsigned char, crypto_generichash_BYTES_MIN> digest{};
  crypto_generichash(digest.data(), digest.size(), key.data(), key.size(), nullptr, 0);
  std::uint64_t number = 0;
  std::memcpy(&number, digest.data(), sizeof number);
  return number;
}

}  // namespace

std::vector<std::string> enum_names(Verdict) {
  return {"genuine", "own", "cut", "unknown", "forged", "replayed", "unkept", "superseded"};
}

Sealer::Sealer(const Key& key, std::string sender, const std::filesystem::path& epoch_file,
               std::optional<std::int64_t> start_ms)
    : key_(key), sender_(std::move(sender)) {
  start_sodium();
  check_name(sender_);
  const auto now =
      static_cast<std::uint64_t>(std::max<std::int64_t>(0, start_ms ? *start_ms : system_ms()));
  const std::uint64_t after = (kept_epoch(epoch_file) >> kDrawnBits) + 1;
  epoch_ = std::max(now, after) << kDrawnBits | randombytes_uniform(1U << kDrawnBits);
  ByteWriter out;
  out.fixed(epoch_);
  if (!epoch_file.empty() && !write_durably(epoch_file, out.bytes())) cannot_write(epoch_file);
}

Sealer::~Sealer() { sodium_memzero(key_.data(), key_.size()); }

std::optional<std::string> Sealer::seal(const std::string& channel, std::string_view payload) {
  std::optional<Key> key = key_of(key_, robot_of(channel));
  if (payload.size() > kLongestPayload || !key) return std::nullopt;
  std::array<char, kNonce> nonce{};
  randombytes_buf(nonce.data(), nonce.size());
  ByteWriter header;
  header.byte(kVersion);
  header.text(sender_);
  header.raw({nonce.data(), nonce.size()});
  header.fixed(static_cast<std::uint16_t>(payload.size()));
  ByteWriter plain;
  plain.fixed(epoch_);
  plain.fixed(++counter_);
  plain.raw(payload);
  const std::string with = associated(channel, header.bytes());
  std::string sealed = header.bytes();
  sealed.resize(sealed.size() + plain.bytes().size() + kTag);
  crypto_aead_xchacha20poly1305_ietf_encrypt(
      raw(sealed) + header.bytes().size(), nullptr, raw(plain.bytes()), plain.bytes().size(),
      raw(with), with.size(), nullptr, raw(std::string_view(nonce.data(), nonce.size())),
      key->data());
  sodium_memzero(key->data(), key->size());
  return sealed;
}

Opened Sealer::opened(const std::string& channel, std::string_view sealed) const {
  return unsealed(key_, "", channel, sealed);
}

Opened unsealed(const Key& key, const std::string& own, const std::string& channel,
                std::string_view sealed) {
  ByteReader in(sealed);
  const std::uint8_t version = in.byte();
  if (!in.failed() && version != kVersion) return {Verdict::unknown};
  std::string sender(in.text());
  const std::string_view nonce = in.raw(kNonce);
  const std::size_t payload = in.fixed<std::uint16_t>();
  if (in.failed() || in.rest() != kLife + payload + kTag) return {Verdict::cut};
  if (sender == own) return {Verdict::own};
  std::optional<Key> robots = key_of(key, robot_of(channel));
  if (!robots) return {Verdict::forged};
  const std::string with = associated(channel, sealed.substr(0, in.at()));
  std::string plain(kLife + payload, '\0');
  const int status = crypto_aead_xchacha20poly1305_ietf_decrypt(
      raw(plain), nullptr, nullptr, raw(sealed) + in.at(), in.rest(), raw(with), with.size(),
      raw(nonce), robots->data());
  sodium_memzero(robots->data(), robots->size());
  if (status != 0) return {Verdict::forged};
  ByteReader life(plain);
  const auto epoch = life.fixed<std::uint64_t>(), counter = life.fixed<std::uint64_t>();
  return {Verdict::genuine, std::move(sender), plain.substr(kLife), epoch, counter};
}

Opener::Opener(const Key& key, std::string own, const std::filesystem::path& window_file)
    : key_(key), own_(std::move(own)) {
  start_sodium();
  check_name(own_);
  load(window_file);
}

Opener::~Opener() {
  ::close(file_);
  sodium_memzero(key_.data(), key_.size());
}

Opened Opener::open(const std::string& channel, std::string_view sealed) {
  Opened opened = unsealed(key_, own_, channel, sealed);
  if (opened.verdict == Verdict::genuine) opened.verdict = take(robot_of(channel), opened);
  ++counts_[static_cast<std::size_t>(opened.verdict)];
  if (opened.verdict != Verdict::genuine) return {opened.verdict};
  return opened;
}

Verdict Opener::take(const std::string& robot, const Opened& message) {
  const Pair pair{message.sender, robot};
  const auto known = heard_.find(pair);
  if (known == heard_.end() && full()) return Verdict::unknown;
  Heard heard = known == heard_.end() ? Heard{.slot = heard_.size()} : known->second;
  if (const std::uint64_t key = number_of(*key_of(key_, robot)); heard.key != key) {
    heard = {.slot = heard.slot, .key = key};
  }
  if (message.epoch < heard.epoch) return Verdict::superseded;
  if (message.epoch > heard.epoch) heard.window = {};
  heard.epoch = message.epoch;
  if (!heard.window.take(message.counter)) return Verdict::replayed;
  if (!keep(pair, heard)) return Verdict::unkept;
  heard_[pair] = heard;
  return Verdict::genuine;
}

// The file: a slot of this form for each pair: both names filled up with zeros, which key, epoch,
// newest counter, bits. No slot lies in two sectors of a disk, which writes those whole.
namespace {

constexpr std::size_t kBitBytes = ReplayWindow::kCounters / 8;
constexpr std::size_t kSlotBytes = 256;
static_assert(2 * kLongestName + 3 * 8 + kBitBytes <= kSlotBytes && 512 % kSlotBytes == 0);

void write_name(ByteWriter& out, const std::string& name) {
  out.raw(name);
  out.raw(std::string(kLongestName - name.size(), '\0'));
}

std::string read_name(ByteReader& in) {
  std::string name(in.raw(kLongestName));
  name.resize(std::min(name.find('\0'), name.size()));
  return name;
}

void write_bits(ByteWriter& out, const ReplayWindow::Taken& taken) {
  for (std::size_t i = 0; i < kBitBytes; ++i) {
    std::uint8_t byte = 0;
    for (std::size_t bit = 0; bit < 8; ++bit) {
      byte = static_cast<std::uint8_t>(byte | taken[8 * i + bit] << bit);
    }
    out.byte(byte);
  }
}

ReplayWindow::Taken read_bits(ByteReader& in) {
  ReplayWindow::Taken taken;
  for (std::size_t i = 0; i < taken.size(); i += 8) {
    const std::uint8_t byte = in.byte();
    for (std::size_t bit = 0; bit < 8; ++bit) taken[i + bit] = byte >> bit & 1;
  }
  return taken;
}

}  // namespace

bool Opener::keep(const Pair& pair, const Heard& heard) const {
  ByteWriter out;
  write_name(out, pair.first);
  write_name(out, pair.second);
  out.fixed(heard.key);
  out.fixed(heard.epoch);
  out.fixed(heard.window.newest());
  write_bits(out, heard.window.taken());
  return write_at(file_, out.bytes(), heard.slot * kSlotBytes) && ::fdatasync(file_) == 0;
}

void Opener::load(const std::filesystem::path& file) {
  file_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  // All of it now, so that a disk that fills up later does not matter.
  if (file_ < 0 || ::posix_fallocate(file_, 0, kMostSenders * kSlotBytes) != 0) cannot_write(file);
  const std::string kept = core::read_file(file);
  if (kept.size() != kMostSenders * kSlotBytes) {
    throw Error(fmt::format("{}: {} bytes, expected the {} of heard counters", file.string(),
                            kept.size(), kMostSenders * kSlotBytes));
  }
  for (std::size_t slot = 0; slot < kMostSenders; ++slot) {
    ByteReader in(std::string_view(kept).substr(slot * kSlotBytes, kSlotBytes));
    const Pair pair{read_name(in), read_name(in)};
    Heard heard{.slot = slot, .key = in.fixed<std::uint64_t>(), .epoch = in.fixed<std::uint64_t>()};
    const auto newest = in.fixed<std::uint64_t>();
    heard.window = ReplayWindow(newest, read_bits(in));
    if (pair.first.empty()) break;
    if (!is_name(pair.first) || !is_name(pair.second)) {
      throw Error(fmt::format("{}: damaged", file.string()));
    }
    heard_[pair] = heard;
  }
}

}  // namespace saker::exchange
