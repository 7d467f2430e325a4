// SHA-256 and Ed25519, by OpenSSL's libcrypto.
#pragma once

#include <string>
#include <string_view>

namespace plumbline::driver {

std::string sha256_hex(std::string_view bytes);
/// Throws DriverError naming a file that cannot be read.
std::string sha256_of_file(const std::string& path);
/// The whole file; throws DriverError naming it when it cannot be read or is larger than 256 MB.
std::string read_bytes(const std::string& path);

std::string to_hex(std::string_view bytes);
/// Throws DriverError for anything but pairs of lower-case hexadecimal digits.
std::string from_hex(std::string_view hex);

/// A pair of keys for Ed25519 (RFC 8032), in the forms that the openssl command reads.
struct KeyPair {
  std::string private_pem;  ///< PKCS #8
  std::string public_pem;   ///< SubjectPublicKeyInfo
};
KeyPair new_key();

/// 64 bytes over `message`. Throws DriverError when the text is no private Ed25519 key.
std::string sign(const std::string& private_pem, std::string_view message);
/// The 32 bytes of the public key: of a private or a public key's PEM.
std::string public_key(const std::string& pem);
/// `key`: its 32 bytes. False for any other signature or message.
bool signature_holds(const std::string& key, std::string_view message, const std::string& signature);

}  // namespace plumbline::driver
