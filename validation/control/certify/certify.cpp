#include "validation/control/certify/certify.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <random>

#include "controllers/driver/signature.h"
#include "simulator/trace/error.h"
#include "simulator/trace/table.h"
#include "validation/control/certify/drawn_robots.h"
#include "validation/control/certify/drive_part.h"
#include "validation/control/certify/lasting.h"
#include "validation/control/certify/ledger.h"
#include "validation/control/certify/probe.h"
#include "validation/control/gait/drawn_models.h"
#include "validation/control/gait/gait_run.h"
#include "validation/control/gait/return_map.h"
#include "work/durations.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;
using driver::Json;
using run::LoadedScenario;

constexpr int kMeasuredRuns = 4;  // of the starts, for quantities
constexpr long kProbed = 5000;    // samples of one run, for the controller's time
constexpr double kPercent = 100.0;

/// One piece of work whose result is kept.
struct Unit {
  std::string key;
  std::function<Json()> work;
};

std::string share_text(double share) { return fmt::format("{:.1f} %", kPercent * share); }

contact::Terrain uneven(const contact::Terrain& flat, const RequiredTerrain& terrain, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> height(-terrain.height, terrain.height);
  std::vector<contact::Platform> platforms;
  // To either side of the start, as far as a hundred steps.
  for (int side : {-1, 1}) {
    for (int k = 1; k <= 100; ++k) {
      // By the same sum at either neighbour, or the edges would overlap by rounding.
      const double near = terrain.level + (k - 1.0) * terrain.length,
                   far = terrain.level + k * terrain.length;
      platforms.push_back({side > 0 ? near : -far, side > 0 ? far : -near, flat.floor() + height(random)});
    }
  }
  return contact::Terrain(flat.floor(), platforms);
}

model::Model with_noise(model::Model model, double counts) {
  for (model::Sensor& sensor : model.sensors) {
    sensor.noise = std::hypot(sensor.noise, counts * sensor.resolution);
  }
  return model;
}

class Certification {
 public:
  Certification(const std::string& file, const CertifyOptions& options)
      : options_(options),
        requirements_(read_all(file)),
        loaded_(run::read_scenario(requirements_.scenario)),
        gait_(gait_of()),
        files_(files_of(requirements_, loaded_)),
        ledger_(options.workers->is_first() ? options.progress : "", identity()) {}

  Certified run() {
    make_units();
    do_units();
    if (!options_.workers->is_first()) {
      return result_;
    }
    judge_shares();
    judge_quantities();
    judge_supervisor();
    judge_margins();
    judge_multiplier();
    take_limits(requirements_.drive, largest_, requirements_.speed_times, requirements_.rest_times,
                requirements_.slew_times);
    judge_steps();
    result_.holds =
        std::all_of(result_.judged.begin(), result_.judged.end(), [](const Judged& j) { return j.holds; });
    make_body();
    return result_;
  }

 private:
  static Requirements read_all(const std::string& file) {
    Requirements requirements = read_requirements(file);
    add_published(requirements);
    return requirements;
  }

  Gait gait_of() {
    complete_drive(requirements_, loaded_);
    const std::optional<Gait> gait = read_gait(loaded_);
    if (!gait) {
      throw InputError({requirements_.scenario, 0, "gait"}, "nothing", "a gait whose cycles can be counted");
    }
    return *gait;
  }

  /// A path as the certificate names it: relative to its folder.
  std::string relative(const std::string& path) const {
    const fs::path folder = fs::absolute(options_.certificate).parent_path();
    return fs::proximate(fs::absolute(path), folder).generic_string();
  }

  /// Everything that a result hangs on.
  std::string identity() {
    std::string text = options_.version + "\n" + PLUMBLINE_LIBRARIES + "\n";
    for (const NamedFile& file : files_) {
      hashes_.push_back(driver::sha256_of_file(file.path));
      text += hashes_.back() + "\n";
    }
    return driver::sha256_hex(text);
  }

  void add_lasting(const std::string& key, LoadedScenario scenario, const WireOfRun& wire,
                   std::uint64_t seed) {
    units_.push_back({key, [this, scenario = std::move(scenario), wire, seed] {
                        LastingOptions options;
                        options.cycles = requirements_.cycles;
                        options.wire = wire;
                        options.seed = seed;
                        return to_json(last(scenario, gait_, requirements_.drive, options));
                      }});
  }

  void make_units() {
    const std::uint64_t seed = requirements_.seed;
    const auto starts = [&](int runs, std::uint64_t of) { return from_starts(loaded_, runs, of); };
    const auto name = [](const char* what, std::size_t k) { return fmt::format("{} {}", what, k); };
    const std::vector<LoadedScenario> first = starts(requirements_.starts.runs, seed);
    for (std::size_t k = 0; k < first.size(); ++k) {
      add_lasting(name("start", k), first[k], {}, seed + k);
      if (k < kMeasuredRuns && !requirements_.quantities.empty()) {
        units_.push_back({name("gait", k), [this, scenario = first[k]] { return measure(scenario); }});
      }
    }
    if (requirements_.robots) {
      const int runs = requirements_.robots->runs;
      const std::vector<model::Model> robots =
          requirements_.robots_share > 0.0
              ? draw_models(loaded_.model, runs, requirements_.robots_share, seed)
              : draw_robots(loaded_.model, runs, seed);
      std::vector<LoadedScenario> all = starts(runs, seed + 1);
      for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].model = robots[k];
        add_lasting(name("robot", k), all[k], {}, seed + k);
      }
    }
    if (requirements_.noise) {
      std::vector<LoadedScenario> all = starts(requirements_.noise->runs, seed + 2);
      for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].model = with_noise(all[k].model, requirements_.noise_counts);
        add_lasting(name("noise", k), all[k], {}, seed + k);
      }
    }
    if (requirements_.wire) {
      const std::vector<LoadedScenario> all = starts(requirements_.wire->runs, seed + 3);
      for (std::size_t k = 0; k < all.size(); ++k) {
        add_lasting(name("wire", k), all[k], {requirements_.wire->lost, requirements_.wire->late}, seed + k);
      }
    }
    if (requirements_.terrain) {
      std::vector<LoadedScenario> all = starts(requirements_.terrain->runs, seed + 4);
      for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].scenario.terrain = uneven(loaded_.scenario.terrain, *requirements_.terrain, seed + k);
        add_lasting(name("terrain", k), all[k], {}, seed + k);
      }
    }
    if (requirements_.multiplier) {
      units_.push_back({"orbit", [this] { return orbit(); }});
    }
  }

  Json measure(const LoadedScenario& scenario) const {
    GaitView view;
    view.gait = gait_;
    view.where = {requirements_.file, 0, "quantities"};
    for (const RequiredQuantity& quantity : requirements_.quantities) {
      view.measures.push_back(quantity.measure);
    }
    GaitOptions options;
    options.enough = requirements_.cycles;
    options.stop = options_.stop;
    const std::vector<GaitRun> runs{run_gait(scenario, view, options)};
    Json result;
    result["counts"] = Json::Array();
    result["sums"] = Json::Array();
    for (std::size_t m = 0; m < view.measures.size(); ++m) {
      const std::vector<const Cycle*> settled = settled_cycles(gait_, runs, requirements_.quantities[m].foot);
      double sum = 0.0;
      for (const double value : values_of(settled, m)) {
        sum += value;
      }
      result["counts"].push_back(static_cast<double>(settled.size()));
      result["sums"].push_back(sum);
    }
    return result;
  }

  Json orbit() const {
    const std::optional<PoincareSection> section = read_section(loaded_);
    if (!section) {
      throw InputError({requirements_.scenario, 0, "gait"}, "no section", "one, for the multiplier");
    }
    OrbitOptions options;
    options.stop = options_.stop;
    const Orbit found = find_orbit(loaded_, *section, options);
    Json result;
    result["settled"] = found.settled;
    result["why_not"] = found.why_not;
    result["found"] = found.found;
    result["residual"] = found.residual;
    result["growth"] = found.growth;
    return result;
  }

  void do_units() {
    work::Durations durations(options_.durations);
    std::vector<work::Task> tasks;
    for (const Unit& unit : units_) {
      tasks.push_back(
          {unit.key, [&unit] { return driver::canonical_json(unit.work()); }, durations.of(unit.key)});
    }
    const std::size_t known = ledger_.size(), open = units_.size() - std::min(known, units_.size());
    std::size_t done = 0;
    work::Watch watch;
    watch.stop = options_.stop != nullptr ? &options_.stop->raised : nullptr;
    watch.known = [&](std::size_t k) {
      const Json* result = ledger_.find(units_[k].key);
      return result == nullptr ? std::nullopt : std::optional<std::string>(driver::canonical_json(*result));
    };
    watch.done = [&](std::size_t k, const std::string& result, double seconds) {
      ledger_.add(units_[k].key, driver::parse_json(result));
      durations.add(units_[k].key, seconds);
      if (options_.report) {
        options_.report(static_cast<double>(++done) / static_cast<double>(open), static_cast<int>(known));
      }
    };
    const bool is_stopped = options_.workers->run(tasks, watch).stopped;
    if (options_.workers->is_first() && !options_.durations.empty()) {
      write_text_atomically(options_.durations, durations.text("task"));
    }
    if (is_stopped) {
      throw Stopped();
    }
  }

  std::vector<LastingRun> runs_of(const char* what, int count) const {
    std::vector<LastingRun> runs;
    for (int k = 0; k < count; ++k) {
      runs.push_back(lasting_run_from(*ledger_.find(fmt::format("{} {}", what, k))));
    }
    return runs;
  }

  void judge(const std::string& name, const std::string& required, const std::string& reached, bool holds) {
    result_.judged.push_back({name, required, reached, holds});
  }

  void judge_share(const char* what, const std::string& name, const RequiredShare& share) {
    int lasted = 0;
    for (const LastingRun& run : runs_of(what, share.runs)) {
      if (!run.end.empty()) {
        continue;
      }
      ++lasted;
      largest_.widen(run.extremes);
      lasted_.push_back(run);
    }
    const double reached = static_cast<double>(lasted) / share.runs;
    judge(name,
          fmt::format("{} of {} runs make {} {}s", share_text(share.at_least), share.runs,
                      requirements_.cycles, to_string(gait_.cycle)),
          fmt::format("{} ({})", share_text(reached), lasted), reached >= share.at_least);
  }

  void judge_shares() {
    judge_share("start", "random starts", requirements_.starts);
    if (requirements_.robots) {
      const std::string drawn =
          requirements_.robots_share > 0.0
              ? fmt::format("robots drawn within {}", share_text(requirements_.robots_share))
              : "robots drawn from the model's uncertainties";
      judge_share("robot", drawn, *requirements_.robots);
    }
    if (requirements_.noise) {
      judge_share("noise", fmt::format("sensor noise of {:g} counts", requirements_.noise_counts),
                  *requirements_.noise);
    }
    if (requirements_.wire) {
      judge_share("wire",
                  fmt::format("{} of samples lost, {} of commands late", share_text(requirements_.wire->lost),
                              share_text(requirements_.wire->late)),
                  *requirements_.wire);
    }
    if (requirements_.terrain) {
      judge_share("terrain",
                  fmt::format("steps of up to {:.3g} m every {:.3g} m", requirements_.terrain->height,
                              requirements_.terrain->length),
                  *requirements_.terrain);
    }
    if (lasted_.empty()) {  // nothing to take limits from: the certificate is refused already
      largest_ = lasting_run_from(*ledger_.find("start 0")).extremes;
    }
  }

  void judge_quantities() {
    const std::size_t runs =
        std::min<std::size_t>(static_cast<std::size_t>(requirements_.starts.runs), kMeasuredRuns);
    for (std::size_t q = 0; q < requirements_.quantities.size(); ++q) {
      const RequiredQuantity& quantity = requirements_.quantities[q];
      double sum = 0.0, count = 0.0;
      for (std::size_t k = 0; k < runs; ++k) {
        const Json& run = *ledger_.find(fmt::format("gait {}", k));
        sum += run.at("sums").array()[q].number();
        count += run.at("counts").array()[q].number();
      }
      const double mean = count > 0.0 ? sum / count : 0.0;
      const double from = quantity.from / quantity.factor, to = quantity.to / quantity.factor;
      const std::string range = to == driver::kNone ? fmt::format("at least {:.4g} {}", from, quantity.unit)
                                : from == -driver::kNone
                                    ? fmt::format("at most {:.4g} {}", to, quantity.unit)
                                    : fmt::format("{:.4g} to {:.4g} {}", from, to, quantity.unit);
      const std::string reached = count > 0.0
                                      ? fmt::format("{:.4g} {} over {:.0f} {}s", mean / quantity.factor,
                                                    quantity.unit, count, to_string(gait_.cycle))
                                      : "no settled cycle";
      judge(quantity.name + " (" + quantity.source + ")", range, reached,
            count > 0.0 && mean >= quantity.from && mean <= quantity.to);
    }
  }

  void judge_supervisor() {
    int stopped = 0;
    std::string first;
    for (const LastingRun& run : lasted_) {
      if (!run.supervisor.empty()) {
        first = stopped == 0 ? run.supervisor : first;
        ++stopped;
      }
    }
    judge("the supervisor lets it run", fmt::format("0 of {} lasting runs stopped", lasted_.size()),
          stopped == 0 ? "0" : fmt::format("{} ({})", stopped, first), stopped == 0 && !lasted_.empty());
  }

  void judge_margins() {
    const driver::Plan& plan = requirements_.drive;
    if (requirements_.command_margin) {
      double least = 1.0;
      std::string where;
      for (std::size_t k = 0; k < plan.commands.size(); ++k) {
        const double margin = 1.0 - largest_.command[static_cast<Eigen::Index>(k)] / plan.commands[k].limit;
        where = margin <= least ? plan.commands[k].name : where;
        least = std::min(least, margin);
      }
      judge("margin of the commands", "at least " + share_text(*requirements_.command_margin),
            fmt::format("{} ({})", share_text(least), where), least >= *requirements_.command_margin);
    }
    if (requirements_.workspace_margin && largest_.margin.size() > 0) {
      Eigen::Index where = 0;
      const double least = largest_.margin.minCoeff(&where);
      judge("margin of the workspace, stopping positions too",
            "at least " + share_text(*requirements_.workspace_margin),
            fmt::format("{} ({})", share_text(least), plan.workspace[static_cast<std::size_t>(where)].name),
            least >= *requirements_.workspace_margin);
    }
  }

  void judge_multiplier() {
    if (!requirements_.multiplier) {
      return;
    }
    const Json& orbit = *ledger_.find("orbit");
    const bool found = orbit.at("found").boolean();
    const double growth = orbit.at("growth").number();
    judge("largest multiplier of the gait", fmt::format("at most {:.3g}", *requirements_.multiplier),
          found ? fmt::format("{:.3g}", growth)
          : !orbit.at("settled").boolean()
              ? orbit.at("why_not").text()
              : fmt::format("{:.3g}, the orbit {:.2g} steps off", growth, orbit.at("residual").number()),
          found && growth <= *requirements_.multiplier);
  }

  /// What is measured in time differs from one computer to the next: the body has the verdict alone.
  void judge_steps() {
    if (!requirements_.step_time && !requirements_.no_allocation) {
      return;
    }
    LastingOptions options;
    options.cycles = 10;
    options.keep = kProbed;
    options.seed = requirements_.seed;
    const LastingRun run = last(loaded_, gait_, requirements_.drive, options);
    const Probed probed =
        probe_controller(loaded_.controller->library.path(), requirements_.drive, run.channels);
    result_.step_p999 = probed.p999;
    if (requirements_.step_time) {
      const bool holds = probed.p999 <= *requirements_.step_time;
      judge("99.9 % of the controller's steps",
            fmt::format("at most {:.3g} us", 1e6 * *requirements_.step_time),
            holds ? "yes" : fmt::format("{:.3g} us", 1e6 * probed.p999), holds);
    }
    if (requirements_.no_allocation) {
      judge("allocations in the controller's steps", "none", std::to_string(probed.allocations),
            probed.allocations == 0);
    }
  }

  void make_body() {
    driver::Plan& plan = requirements_.drive;
    Json& body = result_.body;
    body["format"] = "plumbline-certificate/1";
    body["title"] = requirements_.title;
    body["valid_until"] = requirements_.valid_until;
    body["model"] = relative(loaded_.model.file);
    body["seeds"]["requirements"] = static_cast<double>(requirements_.seed);
    body["versions"]["plumbline"] = options_.version;
    body["versions"]["libraries"] = PLUMBLINE_LIBRARIES;
    for (std::size_t k = 0; k < files_.size(); ++k) {
      Json file;
      file["file"] = relative(files_[k].path);
      file["role"] = files_[k].role;
      file["sha256"] = hashes_[k];
      body["files"].push_back(file);
      if (files_[k].role == "controller library") {
        plan.library = relative(files_[k].path);
        plan.library_sha256 = hashes_[k];
      }
    }
    body["controller"] = controller_json(plan);
    body["drive"] = drive_json(plan);
    for (const Judged& judged : result_.judged) {
      Json one;
      one["name"] = judged.name;
      one["required"] = judged.required;
      one["reached"] = judged.reached;
      one["holds"] = judged.holds;
      body["requirements"].push_back(one);
    }
    for (const Unit& unit : units_) {
      body["runs"][unit.key] = *ledger_.find(unit.key);
    }
  }

  CertifyOptions options_;
  Requirements requirements_;
  LoadedScenario loaded_;
  Gait gait_;
  std::vector<NamedFile> files_;
  std::vector<std::string> hashes_;
  Ledger ledger_;
  std::vector<Unit> units_;
  std::vector<LastingRun> lasted_;
  Extremes largest_;
  Certified result_;
};

}  // namespace

Certified certify(const std::string& requirements, const CertifyOptions& options) {
  return Certification(requirements, options).run();
}

}  // namespace plumbline::validation
