#include "flight/mavlink/signing.h"

#include <sodium.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "saker/core/error.h"

namespace saker::flight::mavlink {
namespace {

constexpr std::int64_t kEpochUnixUs = 1'420'070'400'000'000;  // 2015-01-01
constexpr SigningTime kMostStamp = (SigningTime{1} << 48) - 1;

}  // namespace

SigningTime signing_time(std::int64_t unix_us) {
  const std::int64_t since = std::max<std::int64_t>(unix_us - kEpochUnixUs, 0) / 10;
  return std::min(static_cast<SigningTime>(since), kMostStamp);
}

SigningKey read_signing_key(const std::filesystem::path& file) {
  const std::string expected = ", expected 64 hexadecimal digits, readable by their owner only";
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0)
    throw Error("signing key " + file.string() + ": there is none" + expected);
  if ((found.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    throw Error("signing key " + file.string() + ": others may read or write it" + expected);
  std::string digits;
  std::ifstream(file) >> digits;
  SigningKey key{};
  std::size_t length = 0;
  if (digits.size() != 2 * key.size() ||
      sodium_hex2bin(key.data(), key.size(), digits.data(), digits.size(), nullptr, &length,
                     nullptr) != 0 ||
      length != key.size())
    throw Error("signing key " + file.string() + ": is none" + expected);
  return key;
}

Signature signature_of(const SigningKey& key, std::span<const std::uint8_t> frame,
                       std::uint8_t link, SigningTime stamp) {
  std::array<std::uint8_t, 7> tail = {link};
  for (std::size_t i = 0; i < 6; ++i) tail[1 + i] = static_cast<std::uint8_t>(stamp >> (8 * i));
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  crypto_hash_sha256_update(&state, key.data(), key.size());
  crypto_hash_sha256_update(&state, frame.data(), frame.size());
  crypto_hash_sha256_update(&state, tail.data(), tail.size());
  std::array<std::uint8_t, crypto_hash_sha256_BYTES> hash{};
  crypto_hash_sha256_final(&state, hash.data());
  Signature signature{};
  std::copy_n(hash.begin(), signature.size(), signature.begin());
  return signature;
}

SigningTime SigningClock::next(SigningTime now) {
  newest_ = std::min(std::max(newest_ + 1, now), kMostStamp);
  return newest_;
}

bool SigningClock::accept(const SignedBy& by, SigningTime now) {
  newest_ = std::max(newest_, std::min(now, kMostStamp));
  Stream* free = nullptr;
  Stream* stream = nullptr;
  for (Stream& s : streams_) {
    if (!s.used)
      free = free ? free : &s;
    else if (s.last.system == by.system && s.last.component == by.component &&
             s.last.link == by.link)
      stream = &s;
  }
  if (stream && by.stamp <= stream->last.stamp) return false;
  if (!stream && (!free || by.stamp + kOldest < newest_)) return false;
  Stream& known = stream ? *stream : *free;
  known = {by, true};
  newest_ = std::max(newest_, by.stamp);
  return true;
}

}  // namespace saker::flight::mavlink
