// A certificate: what was proven of a controller, signed.
#pragma once

#include <string>
#include <vector>

#include "controllers/driver/json.h"

namespace plumbline::driver {

/// The file is {"body": ..., "key": ..., "signature": ...} in canonical form and a line feed. `key` is the
/// public Ed25519 key and `signature` that over the canonical form of the body, both in hexadecimal digits.
struct Certificate {
  std::string file;  ///< as it was named
  Json body;
  std::string key;  ///< 32 bytes
};

/// A file that the body names: of `files`, each {"file", "role", "sha256"}, the path relative to the
/// certificate's folder.
struct CertifiedFile {
  std::string file, role, sha256;
};

/// The certificate's text, signed with a private key (PEM).
std::string signed_certificate(const Json& body, const std::string& private_pem);

/// Throws DriverError, one line that begins with `file`: it cannot be read, is not canonical, or the
/// signature does not hold. Says nothing about whose key it is.
Certificate read_certificate(const std::string& file);
Certificate parse_certificate(const std::string& text, const std::string& file);

/// Throws DriverError unless the certificate's key is that of the PEM file.
void check_key(const Certificate& certificate, const std::string& key_file);

/// Throws DriverError when the last valid day is over (UTC). `today`: "2026-03-01"; dates compare as texts.
void check_date(const Certificate& certificate, const std::string& today);
std::string today_utc();

std::vector<CertifiedFile> certified_files(const Certificate& certificate);
/// The file's path as seen from here.
std::string path_of(const Certificate& certificate, const std::string& file);
/// Throws DriverError naming the first file that is missing or has changed.
void check_files(const Certificate& certificate);

}  // namespace plumbline::driver
