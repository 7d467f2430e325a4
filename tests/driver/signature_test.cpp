// Keys, signatures and the certificate around them.
#include "controllers/driver/signature.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "controllers/driver/certificate.h"

namespace plumbline::driver {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "certificate-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() { fs::remove_all(path_); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream((path_ / name), std::ios::binary) << bytes;
    return (path_ / name).string();
  }
  std::string path(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

int run(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()); }

Json small_body(const std::string& library_hash) {
  Json body;
  body["format"] = "plumbline-certificate/1";
  body["valid_until"] = "2099-12-31";
  Json file;
  file["file"] = "controller.so";
  file["role"] = "controller";
  file["sha256"] = library_hash;
  body["files"] = Json::Array{file};
  return body;
}

// RFC 8032, section 7.1, test 1; the key in PKCS #8 as RFC 8410 has it.
TEST(Signature, IsThatOfRfc8032) {
  const std::string pem =
      "-----BEGIN PRIVATE KEY-----\n"
      "MC4CAQAwBQYDK2VwBCIEIJ1hsZ3v/VpguoRK9JLsLMREScVpezJpGXA7rAMcrn9g\n"
      "-----END PRIVATE KEY-----\n";
  EXPECT_EQ(to_hex(public_key(pem)), "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a");
  EXPECT_EQ(to_hex(sign(pem, "")),
            "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39701cf9b46b"
            "d25bf5f0595bbe24655141438e7a100b");
}

TEST(Signature, Sha256IsThatOfFips180) {
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Signature, TheOpensslCommandAgrees) {
  const Folder folder;
  const KeyPair key = new_key();
  const Json body = small_body(sha256_hex("bytes"));
  const std::string certificate = signed_certificate(body, key.private_pem);
  const Json whole = parse_json(certificate);
  const std::string message = folder.write("body", canonical_json(whole.at("body")));
  const std::string signature = folder.write("signature", from_hex(whole.at("signature").text()));
  const std::string public_pem = folder.write("key.pub", key.public_pem);
  const std::string verify = "openssl pkeyutl -verify -rawin -pubin -inkey " + public_pem + " -in " + message;
  EXPECT_EQ(run(verify + " -sigfile " + signature), 0);
  folder.write("body", canonical_json(whole.at("body")) + " ");
  EXPECT_NE(run(verify + " -sigfile " + signature), 0);

  // And the other way round: a key and a signature that the command has made.
  const std::string other = folder.path("other.key");
  ASSERT_EQ(run("openssl genpkey -algorithm ed25519 -out " + other), 0);
  ASSERT_EQ(run("openssl pkeyutl -sign -rawin -inkey " + other + " -in " + message + " -out " + signature),
            0);
  EXPECT_TRUE(signature_holds(public_key(read_bytes(other)), read_bytes(message), read_bytes(signature)));
}

TEST(Certificate, EveryChangedByteIsRefused) {
  const KeyPair key = new_key();
  const std::string text = signed_certificate(small_body(sha256_hex("bytes")), key.private_pem);
  EXPECT_NO_THROW(parse_certificate(text, "a.cert"));
  for (std::size_t k = 0; k < text.size(); ++k) {
    std::string changed = text;
    changed[k] = static_cast<char>(changed[k] ^ (1 << (k % 8)));
    try {
      parse_certificate(changed, "a.cert");
      FAIL() << "byte " << k;
    } catch (const DriverError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("a.cert: ", 0), 0U) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_THROW(parse_certificate(text + "\n", "a.cert"), DriverError);
  EXPECT_THROW(parse_certificate(text.substr(0, text.size() - 1), "a.cert"), DriverError);
}

TEST(Certificate, ChecksKeyDateAndFiles) {
  const Folder folder;
  const KeyPair key = new_key(), other = new_key();
  const std::string mine = folder.write("mine.pub", key.public_pem);
  const std::string theirs = folder.write("theirs.pub", other.public_pem);
  const std::string file =
      folder.write("a.cert", signed_certificate(small_body(sha256_hex("bytes")), key.private_pem));
  const Certificate certificate = read_certificate(file);
  EXPECT_NO_THROW(check_key(certificate, mine));
  EXPECT_THROW(check_key(certificate, theirs), DriverError);
  EXPECT_NO_THROW(check_date(certificate, "2099-12-31"));
  EXPECT_THROW(check_date(certificate, "2100-01-01"), DriverError);
  EXPECT_THROW(check_files(certificate), DriverError);  // is missing
  folder.write("controller.so", "bytes");
  EXPECT_NO_THROW(check_files(certificate));
  folder.write("controller.so", "byteS");
  try {
    check_files(certificate);
    FAIL();
  } catch (const DriverError& error) {
    EXPECT_NE(std::string(error.what()).find("controller.so: is not the file that was certified"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace plumbline::driver
