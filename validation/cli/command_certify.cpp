#include <fmt/core.h>

#include "controllers/driver/certificate.h"
#include "controllers/driver/plan.h"
#include "controllers/driver/signature.h"
#include "simulator/trace/error.h"
#include "simulator/trace/table.h"
#include "validation/cli/driving_commands.h"
#include "validation/cli/files.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/ranks.h"
#include "validation/control/certify/certify.h"

namespace plumbline::cli {
namespace {

struct Options {
  std::string requirements, key, out, body;
  int threads = 0;
};

void print(const validation::Certified& certified) {
  std::vector<std::vector<std::string>> rows;
  for (const validation::Judged& judged : certified.judged) {
    rows.push_back({judged.name, judged.required, judged.reached, judged.holds ? "holds" : "FAILS"});
  }
  print_table({"requirement", "required", "reached", "verdict"}, rows);
  if (certified.step_p999 > 0.0) {
    fmt::print("\n99.9 % of the controller's steps took less than {:.2f} us here and now.\n",
               1e6 * certified.step_p999);
  }
}

/// As the robot's computer will: signature, files, and the plan that the driver makes of it.
void read_back(const std::string& file) {
  try {
    const driver::Certificate certificate = driver::read_certificate(file);
    driver::check_files(certificate);
    driver::plan_from(certificate.body);
  } catch (const driver::DriverError& error) {
    throw InputError(error.what());
  }
}

void run(const Options& options, Outcome& outcome) {
  if (workers().is_first()) {
    check_writable(options.out);
    check_writable(options.body);
  }
  validation::CertifyOptions certify;
  certify.certificate = options.out;
  certify.progress = options.out + ".progress";
  certify.durations = options.out + ".durations";
  certify.version = PLUMBLINE_VERSION;
  work::Threads threads(options.threads > 0 ? options.threads : work::cores());
  certify.workers = workers().ranks() > 1 ? &workers() : &threads;
  certify.stop = &stop_flag();
  ProgressLine line;
  const validation::Progress show = line.callback();
  certify.report = [&](double share, int known) {
    show(known > 0 ? fmt::format("certifying, {} runs known", known) : "certifying", share);
  };
  std::string private_pem;
  validation::Certified certified;
  try {
    private_pem = driver::read_bytes(options.key);
    driver::sign(private_pem, "");  // a wrong key is refused before hours of work
  } catch (const driver::DriverError& error) {
    const std::string what = error.what();
    throw InputError(what.rfind(options.key, 0) == 0 ? what : options.key + ": " + what);
  }
  certified = validation::certify(options.requirements, certify);
  if (!workers().is_first()) {
    return;
  }
  print(certified);
  if (!options.body.empty()) {
    write_text_atomically(options.body, driver::canonical_json(certified.body));
  }
  if (!certified.holds) {
    fmt::print("\nNo certificate: a requirement fails.\n");
    outcome.status = 1;
    return;
  }
  write_text_atomically(options.out, driver::signed_certificate(certified.body, private_pem));
  read_back(options.out);
  fmt::print("\n{}: valid until {}, signed by key {}...\n", options.out,
             certified.body.at("valid_until").text(),
             driver::to_hex(driver::public_key(private_pem)).substr(0, 16));
}

}  // namespace

void add_certify(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "certify", "Hold a controller against requirements, and sign what was proven; long, and resumable");
  command->add_option("requirements", options->requirements, "file of requirements")
      ->required()
      ->type_name("FILE");
  command->add_option("--key", options->key, "private key (plumbline key new)")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--out", options->out, "the certificate; beside it the progress is kept")
      ->required()
      ->type_name("FILE");
  command->add_option("--body", options->body, "write the body alone, too, whether all holds or not")
      ->type_name("FILE");
  command
      ->add_option("--threads", options->threads,
                   "runs at a time; otherwise one for each core (several ranks: one each)")
      ->check(CLI::Range(1, 1024));
  command->footer(
      "Example:\n  plumbline certify robots/mabel/certify/hopping.yaml --key lab.key -o hopping.cert");
  command->callback([options, &outcome] { run(*options, outcome); });
}

}  // namespace plumbline::cli
