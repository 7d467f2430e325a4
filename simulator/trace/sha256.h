// SHA-256 (FIPS 180-4, by OpenSSL's libcrypto), 64 hexadecimal digits.
#pragma once

#include <string>

namespace plumbline {

std::string sha256_of(const std::string& bytes);

/// Of a file's content. Throws InputError when it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace plumbline
