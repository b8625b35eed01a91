#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <algorithm>
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
using Memory = std::unique_ptr<BIO, Freed<BIO, BIO_free_all>>;

/// Its owner's alone before anything is in it; whole under its name, or not there.
void write_secret(const fs::path& path, const std::string& content) {
  const fs::path fresh = path.string() + ".new";
  core::write_file(fresh, "");
  fs::permissions(fresh, kOwner);
  File file(std::fopen(fresh.c_str(), "w"));
  bool fine = file && std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
  fine = file && std::fclose(file.release()) == 0 && fine;
  std::error_code failed;
  if (fine) fs::rename(fresh, path, failed);
  if (!fine || failed) throw Error("cannot write " + path.string());
}

/// What an earlier start began to write is not there.
bool is_there(const fs::path& path) {
  std::error_code failed;
  const auto size = fs::file_size(path, failed);
  return !failed && size > 0;
}

/// \param write  into memory, as OpenSSL's PEM_write_bio_… do
template <class Write>
std::string pem(Write write) {
  const Memory memory(BIO_new(BIO_s_mem()));
  if (!memory || write(memory.get()) != 1) throw Error("OpenSSL cannot write PEM");
  std::string text(BIO_ctrl_pending(memory.get()), '\0');
  if (BIO_read(memory.get(), text.data(), static_cast<int>(text.size())) !=
      static_cast<int>(text.size()))
    throw Error("OpenSSL cannot write PEM");
  return text;
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
  std::error_code none;
  fs::remove(into.certificate, none);  // it is of another key until the new one is there
  write_secret(into.private_key, pem([&](BIO* out) {
                 return PEM_write_bio_PrivateKey(out, key.get(), nullptr, nullptr, 0, nullptr,
                                                 nullptr);
               }));
  write_secret(into.certificate,
               pem([&](BIO* out) { return PEM_write_bio_X509(out, certificate.get()); }));
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

/// A line of an address: nothing that would have to be written otherwise there.
std::string read_key(const fs::path& file) {
  constexpr std::size_t kLeast = 16, kMost = 200;
  std::string key = core::read_file(file);
  while (!key.empty() && (key.back() == '\n' || key.back() == '\r')) key.pop_back();
  if (key.size() < kLeast || key.size() > kMost)
    throw Error(file.string() + ": " + std::to_string(key.size()) +
                " characters, expected 16 to 200");
  const auto plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
           c == '_';
  };
  if (!std::ranges::all_of(key, plain))
    throw Error(file.string() + ": expected letters, digits, '-' and '_' alone");
  return key;
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
  if (!is_there(key_file)) write_secret(key_file, drawn_key() + "\n");
  result.key = read_key(key_file);
  if (!is_there(result.certificate) || !is_there(result.private_key))
    draw_certificate(result, address);
  result.fingerprint = fingerprint_of(result.certificate);
  return result;
}

}  // namespace saker::flight::ground
