#include "controllers/driver/certificate.h"

#include <ctime>

#include "controllers/driver/signature.h"

namespace plumbline::driver {
namespace {

constexpr const char* kFormat = "plumbline-certificate/1";

bool is_date(const std::string& text) {
  if (text.size() != 10) return false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool dash = k == 4 || k == 7;
    if (dash ? text[k] != '-' : text[k] < '0' || text[k] > '9') return false;
  }
  return true;
}

// Runs `work` and puts the file's name before what it complains about.
template <typename Work>
auto naming(const std::string& file, Work work) {
  try {
    return work();
  } catch (const DriverError& error) {
    throw DriverError(file + ": " + error.what());
  }
}

}  // namespace

std::string signed_certificate(const Json& body, const std::string& private_pem) {
  Json whole;
  whole["body"] = body;
  whole["key"] = to_hex(public_key(private_pem));
  whole["signature"] = to_hex(sign(private_pem, canonical_json(body)));
  return canonical_json(whole) + "\n";
}

Certificate parse_certificate(const std::string& text, const std::string& file) {
  return naming(file, [&] {
    const Json whole = parse_json(text);
    if (canonical_json(whole) + "\n" != text)
      throw DriverError("is not in canonical form: it has been changed");
    if (whole.object().size() != 3) throw DriverError("expected exactly body, key and signature");
    Certificate certificate;
    certificate.file = file;
    certificate.body = whole.at("body");
    certificate.key = from_hex(whole.at("key").text());
    if (!signature_holds(certificate.key, canonical_json(certificate.body),
                         from_hex(whole.at("signature").text()))) {
      throw DriverError("the signature does not hold: it has been changed");
    }
    const std::string& format = certificate.body.at("format").text();
    if (format != kFormat) throw DriverError("found format \"" + format + "\", expected " + kFormat);
    if (!is_date(certificate.body.at("valid_until").text()))
      throw DriverError("valid_until: expected YYYY-MM-DD");
    return certificate;
  });
}

Certificate read_certificate(const std::string& file) { return parse_certificate(read_bytes(file), file); }

void check_key(const Certificate& certificate, const std::string& key_file) {
  const std::string pem = read_bytes(key_file);
  const std::string key = naming(key_file, [&] { return public_key(pem); });
  if (key != certificate.key) {
    throw DriverError(certificate.file + ": signed by key " + to_hex(certificate.key).substr(0, 16) +
                      "..., expected the one of " + key_file + " (" + to_hex(key).substr(0, 16) + "...)");
  }
}

void check_date(const Certificate& certificate, const std::string& today) {
  const std::string& last = certificate.body.at("valid_until").text();
  if (today > last)
    throw DriverError(certificate.file + ": expired: valid until " + last + ", today is " + today);
}

std::string today_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
  return text;
}

std::vector<CertifiedFile> certified_files(const Certificate& certificate) {
  return naming(certificate.file, [&] {
    std::vector<CertifiedFile> files;
    for (const Json& one : certificate.body.at("files").array()) {
      files.push_back({one.at("file").text(), one.at("role").text(), one.at("sha256").text()});
    }
    return files;
  });
}

std::string path_of(const Certificate& certificate, const std::string& file) {
  if (!file.empty() && file[0] == '/') return file;
  const std::size_t slash = certificate.file.rfind('/');
  return slash == std::string::npos ? file : certificate.file.substr(0, slash + 1) + file;
}

void check_files(const Certificate& certificate) {
  for (const CertifiedFile& one : certified_files(certificate)) {
    const std::string path = path_of(certificate, one.file);
    const std::string found = sha256_of_file(path);
    if (found != one.sha256) {
      throw DriverError(path + ": is not the file that was certified (SHA-256 " + found.substr(0, 16) +
                        "..., certified " + one.sha256.substr(0, 16) + "...)");
    }
  }
}

}  // namespace plumbline::driver
