#include <filesystem>
#include <fstream>

#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/sha256.h"
#include "simulator/trace/table.h"
#include "validation/api/diagnosing.h"
#include "validation/api/fitting.h"
#include "validation/api/loading.h"
#include "validation/batch/batch.h"
#include "validation/identify/compare/compare.h"
#include "validation/identify/predict/kept_results.h"
#include "validation/report/repeat_json.h"
#include "validation/report/result_json.h"

namespace plumbline::batch {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json head_of(const Row& row) {
  return {{"plumbline", "batch_row/1"},  {"label", row.label},  {"robot", row.robot}, {"day", row.day},
          {"mode", to_string(row.mode)}, {"trials", row.trials}};
}

/// Everything that the row's result hangs on.
std::string inputs_of(const Row& row, const api::Loaded& loaded) {
  std::vector<validation::Trial> trials = loaded.data->trials;
  trials.insert(trials.end(), loaded.data->tests.begin(), loaded.data->tests.end());
  const json options{to_string(row.mode), row.window, row.free, row.without, row.most, head_of(row)};
  return sha256_of(validation::inputs_hash(loaded.model, trials) + options.dump());
}

/// The row as it was finished from the same inputs; nothing when it was not.
std::optional<json> finished(const std::string& file, const std::string& inputs) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) {
    return std::nullopt;
  }
  const json row = json::parse(read_text(file), nullptr, false);
  const bool is_same =
      row.is_object() && row.value("inputs", "") == inputs && row.value("status", "") == "done";
  return is_same ? std::optional<json>(row) : std::nullopt;
}

/// What a diagnosis finds out on its way stays in a file beside the rows until the row is finished.
void keep_on_the_way(const api::Loaded& loaded, const std::string& file) {
  try {
    api::keep_results(loaded, file);
  } catch (const InputError&) {  // of other inputs, or cut off: nothing that is of use
    std::error_code none;
    fs::remove(file, none);
    api::keep_results(loaded, file);
  }
}

json diagnosed(const Row& row, const api::Loaded& loaded) {
  validation::Policy policy;
  policy.most_effects = row.most > 0 ? row.most : policy.most_effects;
  const auto quiet = [](const std::string&, double) {};
  const api::Answer answer = api::diagnose(loaded, api::catalogue_without(row.without), policy, quiet);
  if (answer.diagnosis.interrupted) {
    throw validation::Stopped();
  }
  return api::to_json(answer);
}

json result_of(const Row& row, const api::Loaded& loaded) {
  if (row.mode == Mode::diagnose) {
    return diagnosed(row, loaded);
  }
  if (row.mode == Mode::compare) {
    return validation::to_json(validation::compare_with_curves(loaded.model, *loaded.data));
  }
  const validation::FitOptions options;
  return api::to_json(api::fit(loaded, row.free, options, [](const std::string&, double) {}), loaded,
                      options);
}

/// The errors of the row's last model, in floors: {"train", "held_out"}.
json errors_of(Mode mode, const json& result) {
  const json& of = mode == Mode::fit                                        ? result.at("after")
                   : mode == Mode::diagnose && !result.at("ladder").empty() ? result.at("ladder").back()
                                                                            : result;
  return {{"train", of.value("train", json())}, {"held_out", of.value("held_out", json())}};
}

json computed(const Row& row, const BatchOptions& options, json head) {
  const api::Loaded loaded =
      api::load(api::Sources{row.trials, row.model, row.data_folder, row.window}, options.stop);
  loaded.data->threads = options.threads;
  head["model"] = loaded.model.file;
  head["inputs"] = inputs_of(row, loaded);
  const std::string file = options.out + "/rows/" + row.label + ".json";
  if (const std::optional<json> known = finished(file, head["inputs"])) {
    return *known;
  }
  const std::string kept = options.out + "/kept/" + row.label + ".results";
  if (row.mode == Mode::diagnose) {
    keep_on_the_way(loaded, kept);
  }
  head["result"] = result_of(row, loaded);
  head["errors"] = errors_of(row.mode, head["result"]);
  head["status"] = "done";
  write_text_atomically(file, head.dump(1) + "\n");
  std::error_code none;
  fs::remove(kept, none);
  return head;
}

}  // namespace

json run_row(const Row& row, const BatchOptions& options) {
  json head = head_of(row);
  try {
    return computed(row, options, head);
  } catch (const validation::Stopped&) {
    throw;
  } catch (const std::exception& error) {
    head["status"] = "failed";
    head["why"] = error.what();
  }
  write_text_atomically(options.out + "/rows/" + row.label + ".json", head.dump(1) + "\n");
  return head;
}

}  // namespace plumbline::batch
