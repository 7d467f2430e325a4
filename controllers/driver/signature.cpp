#include "controllers/driver/signature.h"

#include <openssl/evp.h>
#include <openssl/pem.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "controllers/driver/json.h"

namespace plumbline::driver {
namespace {

constexpr std::size_t kLargestFile = 256U << 20U;

struct Free {
  void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
  void operator()(EVP_PKEY_CTX* context) const { EVP_PKEY_CTX_free(context); }
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  void operator()(BIO* bio) const { BIO_free(bio); }
  void operator()(std::FILE* file) const { std::fclose(file); }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

const unsigned char* bytes_of(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

Owned<EVP_PKEY> read_key(const std::string& pem, bool secret) {
  const Owned<BIO> bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  // An empty pass phrase: never asks at a terminal.
  char none[] = "";
  Owned<EVP_PKEY> key(secret ? PEM_read_bio_PrivateKey(bio.get(), nullptr, nullptr, none)
                             : PEM_read_bio_PUBKEY(bio.get(), nullptr, nullptr, none));
  if (key && EVP_PKEY_get_id(key.get()) != EVP_PKEY_ED25519) key.reset();
  return key;
}

std::string pem_of(EVP_PKEY* key, bool secret) {
  const Owned<BIO> bio(BIO_new(BIO_s_mem()));
  const int done = secret
                       ? PEM_write_bio_PKCS8PrivateKey(bio.get(), key, nullptr, nullptr, 0, nullptr, nullptr)
                       : PEM_write_bio_PUBKEY(bio.get(), key);
  if (done != 1) throw DriverError("libcrypto cannot write a key");
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

}  // namespace

std::string to_hex(std::string_view bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    out.push_back(kDigits[byte >> 4U]);
    out.push_back(kDigits[byte & 15U]);
  }
  return out;
}

std::string from_hex(std::string_view hex) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    throw DriverError("expected pairs of lower-case hexadecimal digits");
  };
  if (hex.size() % 2 != 0) throw DriverError("expected pairs of lower-case hexadecimal digits");
  std::string out;
  for (std::size_t k = 0; k < hex.size(); k += 2) {
    out.push_back(static_cast<char>(digit(hex[k]) * 16 + digit(hex[k + 1])));
  }
  return out;
}

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, 32> digest{};
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1) {
    throw DriverError("libcrypto cannot make a SHA-256");
  }
  return to_hex({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

std::string read_bytes(const std::string& path) {
  const Owned<std::FILE> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw DriverError(path + ": " + std::strerror(errno));
  std::string bytes;
  std::array<char, 65536> part{};
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), file.get())) {
    bytes.append(part.data(), n);
    if (bytes.size() > kLargestFile) throw DriverError(path + ": larger than 256 MB");
  }
  if (std::ferror(file.get()) != 0) throw DriverError(path + ": cannot be read");
  return bytes;
}

std::string sha256_of_file(const std::string& path) { return sha256_hex(read_bytes(path)); }

KeyPair new_key() {
  const Owned<EVP_PKEY_CTX> context(EVP_PKEY_CTX_new_id(EVP_PKEY_ED25519, nullptr));
  EVP_PKEY* made = nullptr;
  if (!context || EVP_PKEY_keygen_init(context.get()) != 1 || EVP_PKEY_keygen(context.get(), &made) != 1) {
    throw DriverError("libcrypto cannot make an Ed25519 key");
  }
  const Owned<EVP_PKEY> key(made);
  return {pem_of(key.get(), true), pem_of(key.get(), false)};
}

std::string sign(const std::string& private_pem, std::string_view message) {
  const Owned<EVP_PKEY> key = read_key(private_pem, true);
  if (!key)
    throw DriverError("found no private Ed25519 key in PEM form (make one with: plumbline key new FILE)");
  const Owned<EVP_MD_CTX> context(EVP_MD_CTX_new());
  std::array<unsigned char, 64> signature{};
  std::size_t size = signature.size();
  if (EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key.get()) != 1 ||
      EVP_DigestSign(context.get(), signature.data(), &size, bytes_of(message), message.size()) != 1) {
    throw DriverError("libcrypto cannot sign");
  }
  return {reinterpret_cast<const char*>(signature.data()), size};
}

std::string public_key(const std::string& pem) {
  Owned<EVP_PKEY> key = read_key(pem, false);
  if (!key) key = read_key(pem, true);
  std::array<unsigned char, 32> raw{};
  std::size_t size = raw.size();
  if (!key || EVP_PKEY_get_raw_public_key(key.get(), raw.data(), &size) != 1) {
    throw DriverError("found no Ed25519 key in PEM form");
  }
  return {reinterpret_cast<const char*>(raw.data()), size};
}

bool signature_holds(const std::string& key, std::string_view message, const std::string& signature) {
  const Owned<EVP_PKEY> known(
      EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, bytes_of(key), key.size()));
  const Owned<EVP_MD_CTX> context(EVP_MD_CTX_new());
  return known && EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, known.get()) == 1 &&
         EVP_DigestVerify(context.get(), bytes_of(signature), signature.size(), bytes_of(message),
                          message.size()) == 1;
}

}  // namespace plumbline::driver
