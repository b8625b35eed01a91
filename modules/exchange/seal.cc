#include "saker/exchange/seal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/exchange/bytes.h"
#include "saker/exchange/durable.h"

namespace saker::exchange {
namespace {

constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kTag = crypto_aead_xchacha20poly1305_ietf_ABYTES;
static_assert(kTag == 16);
// Counters that one write to the disk reserves; what a sudden end leaves unused is never used.
constexpr std::uint64_t kBlock = 1 << 16;

using Nonce = std::array<unsigned char, crypto_aead_xchacha20poly1305_ietf_NPUBBYTES>;

const unsigned char* raw(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

/// Of name and counter: as these never come twice, neither does the nonce.
Nonce nonce_of(std::string_view sender, std::uint64_t counter) {
  constexpr std::size_t kNameBytes = std::tuple_size_v<Nonce> - sizeof counter;
  static_assert(kNameBytes >= crypto_generichash_BYTES_MIN);
  Nonce nonce{};
  crypto_generichash(nonce.data(), kNameBytes, raw(sender), sender.size(), nullptr, 0);
  for (std::size_t i = 0; i < sizeof counter; ++i) {
    nonce[kNameBytes + i] = static_cast<unsigned char>(counter >> (8 * i));
  }
  return nonce;
}

/// What stands before the encrypted payload.
struct Header {
  std::string sender;
  std::uint64_t counter = 0;
  std::uint16_t payload = 0;  // bytes
};

std::string to_bytes(const Header& header) {
  ByteWriter out;
  out.byte(kVersion);
  out.text(header.sender);
  out.fixed(header.counter);
  out.fixed(header.payload);
  return out.bytes();
}

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

}  // namespace

std::vector<std::string> enum_names(Verdict) {
  return {"genuine", "own", "cut", "unknown", "forged", "replayed", "unkept"};
}

Sealer::Sealer(const Key& key, std::string sender, std::filesystem::path counter_file)
    : key_(key), sender_(std::move(sender)), file_(std::move(counter_file)) {
  start_sodium();
  check_name(sender_);
  if (std::filesystem::exists(file_)) {
    const std::string kept = core::read_file(file_);
    ByteReader in(kept);
    next_ = in.fixed<std::uint64_t>();
    if (!in.done()) {
      throw Error(
          fmt::format("{}: {} bytes, expected the 8 of a counter", file_.string(), kept.size()));
    }
  }
  reserved_ = next_;
  if (!reserve()) {
    throw Error(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
  }
}

Sealer::~Sealer() { sodium_memzero(key_.data(), key_.size()); }

bool Sealer::reserve() {
  ByteWriter out;
  out.fixed(reserved_ + kBlock);
  if (!write_durably(file_, out.bytes())) return false;
  reserved_ += kBlock;
  return true;
}

std::optional<std::string> Sealer::seal(const std::string& channel, std::string_view payload) {
  if (payload.size() > kLongestPayload || (next_ == reserved_ && !reserve())) return std::nullopt;
  const std::uint64_t counter = next_++;
  std::string sealed =
      to_bytes(Header{sender_, counter, static_cast<std::uint16_t>(payload.size())});
  const std::string with = associated(channel, sealed);
  const std::size_t at = sealed.size();
  sealed.resize(at + payload.size() + kTag);
  crypto_aead_xchacha20poly1305_ietf_encrypt(
      reinterpret_cast<unsigned char*>(&sealed[at]), nullptr, raw(payload), payload.size(),
      raw(with), with.size(), nullptr, nonce_of(sender_, counter).data(), key_.data());
  return sealed;
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
  Opened opened = judged(channel, sealed);
  ++counts_[static_cast<std::size_t>(opened.verdict)];
  return opened;
}

Opened Opener::judged(const std::string& channel, std::string_view sealed) {
  ByteReader in(sealed);
  const std::uint8_t version = in.byte();
  if (!in.failed() && version != kVersion) return {Verdict::unknown, "", ""};
  Header header;
  header.sender = in.text();
  header.counter = in.fixed<std::uint64_t>();
  header.payload = in.fixed<std::uint16_t>();
  if (in.failed() || in.rest() != header.payload + kTag) return {Verdict::cut, "", ""};
  if (header.sender == own_) return {Verdict::own, "", ""};

  const std::string with = associated(channel, sealed.substr(0, in.at()));
  std::string payload(header.payload, '\0');
  const int status = crypto_aead_xchacha20poly1305_ietf_decrypt(
      reinterpret_cast<unsigned char*>(payload.data()), nullptr, nullptr, raw(sealed) + in.at(),
      in.rest(), raw(with), with.size(), nonce_of(header.sender, header.counter).data(),
      key_.data());
  if (status != 0) return {Verdict::forged, "", ""};
  const Verdict verdict = take(header.sender, header.counter);
  if (verdict != Verdict::genuine) return {verdict, "", ""};
  return {verdict, std::move(header.sender), std::move(payload)};
}

Verdict Opener::take(const std::string& sender, std::uint64_t counter) {
  const auto known = windows_.find(sender);
  if (known == windows_.end() && windows_.size() >= kMostSenders) return Verdict::unknown;
  Window window =
      known == windows_.end() ? Window{.slot = windows_.size(), .newest = counter} : known->second;
  if (counter > window.newest) {
    const std::uint64_t ahead = counter - window.newest;
    window.heard = ahead < kWindow ? window.heard << ahead : std::bitset<kWindow>();
    window.newest = counter;
  }
  const std::uint64_t behind = window.newest - counter;
  if (behind >= kWindow || window.heard[behind]) return Verdict::replayed;
  window.heard.set(behind);
  if (!keep(sender, window)) return Verdict::unkept;
  windows_[sender] = window;
  return Verdict::genuine;
}

// The file: a slot of this form for each sender: name filled up with zeros, newest counter, bits.
namespace {
constexpr std::size_t kBitBytes = 1024 / 8;
constexpr std::size_t kSlotBytes = kLongestName + 8 + kBitBytes;
}  // namespace

/// Written, not synced: the kernel has it whatever ends this process.
bool Opener::keep(const std::string& sender, const Window& window) const {
  static_assert(kWindow == 8 * kBitBytes);
  ByteWriter out;
  out.raw(sender);
  for (std::size_t i = sender.size(); i < kLongestName; ++i) out.byte(0);
  out.fixed(window.newest);
  for (std::size_t i = 0; i < kBitBytes; ++i) {
    std::uint8_t byte = 0;
    for (std::size_t bit = 0; bit < 8; ++bit) {
      byte = static_cast<std::uint8_t>(byte | window.heard[8 * i + bit] << bit);
    }
    out.byte(byte);
  }
  return write_at(file_, out.bytes(), window.slot * kSlotBytes);
}

void Opener::load(const std::filesystem::path& file) {
  file_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  // All of it now, so that a disk that fills up later does not matter.
  if (file_ < 0 || ::posix_fallocate(file_, 0, kMostSenders * kSlotBytes) != 0) {
    throw Error(fmt::format("cannot write {}: {}", file.string(), std::strerror(errno)));
  }
  const std::string kept = core::read_file(file);
  if (kept.size() != kMostSenders * kSlotBytes) {
    throw Error(fmt::format("{}: {} bytes, expected the {} of heard counters", file.string(),
                            kept.size(), kMostSenders * kSlotBytes));
  }
  ByteReader in(kept);
  for (std::size_t slot = 0; slot < kMostSenders; ++slot) {
    std::string sender(in.raw(kLongestName));
    sender.resize(std::min(sender.find('\0'), kLongestName));
    Window window{.slot = slot, .newest = in.fixed<std::uint64_t>()};
    for (std::size_t i = 0; i < kWindow; i += 8) {
      const std::uint8_t byte = in.byte();
      for (std::size_t bit = 0; bit < 8; ++bit) window.heard[i + bit] = byte >> bit & 1;
    }
    if (sender.empty()) break;
    if (!is_name(sender)) throw Error(fmt::format("{}: damaged", file.string()));
    windows_[sender] = window;
  }
}

}  // namespace saker::exchange
