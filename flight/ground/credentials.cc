#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <array>
#include <cstdio>
#include <memory>

#include "flight/ground/access.h"
#include "saker/core/error.h"
#include "saker/core/files.h"

/// Key and certificate, by OpenSSL.
namespace saker::flight::ground {
namespace {

namespace fs = std::filesystem;

template <class T, void (*Free)(T*)>
struct Freed {
  void operator()(T* p) const { Free(p); }
};
using PrivateKey = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY, EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<X509, X509_free>>;

constexpr fs::perms kOwner = fs::perms::owner_read | fs::perms::owner_write;

struct Closed {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closed>;

/// Empty, and its owner's alone before anything is in it.
File open_secret(const fs::path& path) {
  core::write_file(path, "");
  fs::permissions(path, kOwner);
  File file(std::fopen(path.c_str(), "w"));
  if (!file) throw Error("cannot write " + path.string());
  return file;
}

std::string drawn_key() {
  constexpr char kDigits[] = "0123456789abcdef";
  std::array<unsigned char, 16> bytes{};
  if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1)
    throw Error("no random numbers from OpenSSL");
  std::string text;
  for (const unsigned char byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

void add_extension(X509* certificate, int kind, const std::string& value) {
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, nullptr, kind, value.c_str());
  if (extension == nullptr) throw Error("ground.listen: no certificate can name " + value);
  X509_add_ext(certificate, extension, -1);
  X509_EXTENSION_free(extension);
}

bool is_number_address(const std::string& address) {
  return address.find_first_not_of("0123456789.:abcdefABCDEF") == std::string::npos &&
         address.find_first_of(".:") != std::string::npos;
}

Certificate self_signed(EVP_PKEY* key, const std::string& address) {
  constexpr long kValid_s = 10L * 365 * 24 * 3600;
  Certificate certificate(X509_new());
  X509_set_version(certificate.get(), 2);  // which is version 3
  std::array<unsigned char, 8> serial{};
  RAND_bytes(serial.data(), static_cast<int>(serial.size()));
  serial[0] &= 0x7f;
  BIGNUM* number = BN_bin2bn(serial.data(), static_cast<int>(serial.size()), nullptr);
  BN_to_ASN1_INTEGER(number, X509_get_serialNumber(certificate.get()));
  BN_free(number);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), 0);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), kValid_s);
  X509_set_pubkey(certificate.get(), key);
  X509_NAME* name = X509_get_subject_name(certificate.get());
  const auto* words = reinterpret_cast<const unsigned char*>("saker-ground");
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, words, -1, -1, 0);
  X509_set_issuer_name(certificate.get(), name);
  const std::string kind = is_number_address(address) ? "IP:" : "DNS:";
  add_extension(certificate.get(), NID_subject_alt_name, kind + address);
  if (X509_sign(certificate.get(), key, EVP_sha256()) == 0)
    throw Error("OpenSSL cannot sign a certificate");
  return certificate;
}

void draw_certificate(const Credentials& into, const std::string& address) {
  const PrivateKey key(EVP_EC_gen("P-256"));
  if (!key) throw Error("OpenSSL cannot draw a key");
  const Certificate certificate = self_signed(key.get(), address);
  const File key_file = open_secret(into.private_key), file = open_secret(into.certificate);
  const bool written =
      PEM_write_PrivateKey(key_file.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1 &&
      PEM_write_X509(file.get(), certificate.get()) == 1;
  if (!written) throw Error("cannot write " + into.certificate.string());
}

std::string fingerprint_of(const fs::path& path) {
  const File file(std::fopen(path.c_str(), "r"));
  if (!file) throw Error("cannot read " + path.string());
  const Certificate certificate(PEM_read_X509(file.get(), nullptr, nullptr, nullptr));
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (!certificate || X509_digest(certificate.get(), EVP_sha256(), digest.data(), &size) != 1)
    throw Error(path.string() + " holds no certificate");
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    char byte[4];
    std::snprintf(byte, sizeof byte, "%s%02X", i > 0 ? ":" : "", digest[i]);
    text += byte;
  }
  return text;
}

}  // namespace

Credentials credentials(const fs::path& folder, const std::string& address) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  Credentials result{.key = {},
                     .key_file = folder / "address.key",
                     .certificate = folder / ("certificate-" + address + ".pem"),
                     .private_key = folder / ("private-key-" + address + ".pem"),
                     .fingerprint = {}};
  const fs::path& key_file = result.key_file;
  if (!fs::exists(key_file)) {
    const File file = open_secret(key_file);
    std::fputs((drawn_key() + "\n").c_str(), file.get());
  }
  result.key = core::read_file(key_file);
  while (!result.key.empty() && result.key.back() == '\n') result.key.pop_back();
  if (result.key.size() < 16)
    throw Error(key_file.string() + ": " + std::to_string(result.key.size()) +
                " characters, expected 16 or more");
  if (!fs::exists(result.certificate) || !fs::exists(result.private_key))
    draw_certificate(result, address);
  result.fingerprint = fingerprint_of(result.certificate);
  return result;
}

}  // namespace saker::flight::ground
