#include <fmt/core.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "controllers/driver/certificate.h"
#include "controllers/driver/plan.h"
#include "controllers/driver/signature.h"
#include "simulator/trace/error.h"
#include "simulator/trace/table.h"
#include "validation/cli/driving_commands.h"
#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

using driver::Certificate;
using driver::DriverError;
using driver::Json;

void describe(const Certificate& certificate) {
  const Json& body = certificate.body;
  fmt::print("{}\nvalid until {}, signed by key {}\nplumbline {}; {}\n\n", body.at("title").text(),
             body.at("valid_until").text(), driver::to_hex(certificate.key),
             body.at("versions").at("plumbline").text(), body.at("versions").at("libraries").text());
  std::vector<std::vector<std::string>> rows;
  for (const Json& one : body.at("requirements").array()) {
    rows.push_back({one.at("name").text(), one.at("required").text(), one.at("reached").text(),
                    one.at("holds").boolean() ? "holds" : "FAILS"});
  }
  print_table({"requirement", "required", "reached", "verdict"}, rows);
  rows.clear();
  for (const driver::CertifiedFile& file : driver::certified_files(certificate)) {
    rows.push_back({file.role, file.file, file.sha256.substr(0, 16) + "..."});
  }
  fmt::print("\n");
  print_table({"file of", "path", "SHA-256"}, rows);
}

/// Whatever does not hold is one line and status 1: the question was whether it does.
void verify(const std::string& file, const std::string& key, const std::string& date, Outcome& outcome) {
  try {
    const Certificate certificate = driver::read_certificate(file);
    if (!key.empty()) {
      driver::check_key(certificate, key);
    }
    driver::check_date(certificate, date.empty() ? driver::today_utc() : date);
    driver::check_files(certificate);
    driver::plan_from(certificate.body);
    describe(certificate);
    fmt::print("\nThe signature holds and every file is the certified one.{}\n",
               key.empty() ? " Whose key it is was not checked: name it with --key." : "");
  } catch (const DriverError& error) {
    fmt::print(stderr, "plumbline: {}\n", error.what());
    outcome.status = 1;
  }
}

void new_key(const std::string& file) {
  const std::string public_file = std::filesystem::path(file).replace_extension(".pub").string();
  for (const std::string& one : {file, public_file}) {
    if (std::filesystem::exists(one)) {
      throw InputError({one, 0, ""}, "a file that is there already", "a new name: keys are not overwritten");
    }
  }
  const driver::KeyPair pair = driver::new_key();
  const mode_t before = umask(0077);
  write_text_atomically(file, pair.private_pem);
  umask(before);
  write_text_atomically(public_file, pair.public_pem);
  fmt::print("{}: private, keep it; {}: public, for the robot's computer.\nkey {}\n", file, public_file,
             driver::to_hex(driver::public_key(pair.public_pem)));
}

}  // namespace

void add_verify(CLI::App& app, Outcome& outcome) {
  struct Options {
    std::string file, key, date;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "verify", "Check a certificate: signature, date, files; what was proven, for what, on what");
  command->add_option("certificate", options->file, "certificate")->required()->type_name("FILE");
  command->add_option("--key", options->key, "public key that must have signed it")->type_name("FILE");
  command->add_option("--date", options->date, "instead of today, YYYY-MM-DD")->type_name("DATE");
  command->callback([options, &outcome] { verify(options->file, options->key, options->date, outcome); });
}

void add_key(CLI::App& app, Outcome& /*outcome*/) {
  auto file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("key", "Keys that sign certificates");
  command->require_subcommand(1);
  CLI::App* make = command->add_subcommand("new", "Make a pair of Ed25519 keys");
  make->add_option("file", *file, "private key; the public one lies beside it as .pub")
      ->required()
      ->type_name("FILE");
  make->callback([file] { new_key(*file); });
}

}  // namespace plumbline::cli
