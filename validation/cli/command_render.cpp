#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/render/film.h"
#include "simulator/render/video.h"
#include "simulator/render/virtual_display.h"
#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/platforms.h"
#include "validation/identify/replay/trial_motion.h"

namespace plumbline::cli {
namespace {

namespace fs = std::filesystem;
using render::Motion;
using render::Snapshots;

constexpr double kLongestVideo = 3600.0;  // s
constexpr int kSmallestSide = 64;         // pixels
constexpr int kLargestSide = 7680;

struct Options {
  std::string trial, trace, model, data_folder, out, json, camera = "side", size = "1280x720";
  std::string at, from, to;
  bool measured = false, whole = false;
  double window = 0.5, slow = 1.0, rate = 60.0, exaggeration = 0.0;
  int strip = 0;
  Platforms platforms;
};

/// What is drawn, and what must live as long as it is.
struct Scene {
  model::Model model;
  std::unique_ptr<model::Plant> plant;
  Motion motion, measured;
  std::vector<std::string> phase_names;
  std::vector<std::string> notes;
};

/// "1.2 s", "1.2s", "800ms" or "1.2".
double time_from(const std::string& option, std::string text) {
  double unit = 1.0;
  const auto ends_with = [&](const std::string& tail) {
    return text.size() > tail.size() && text.compare(text.size() - tail.size(), tail.size(), tail) == 0;
  };
  for (const auto& [name, size] : {std::pair<const char*, double>{"ms", 1e-3}, {"s", 1.0}}) {
    if (ends_with(name)) {
      unit = size;
      text.resize(text.size() - std::string(name).size());
      break;
    }
  }
  while (!text.empty() && text.back() == ' ') {
    text.pop_back();
  }
  const std::optional<double> value = parse_number(text);
  if (!value) {
    throw InputError({"", 0, option}, "\"" + text + "\"", "a time, such as 1.2s or 800ms");
  }
  return unit * *value;
}

struct Size {
  int width, height;
};

/// An even number of pixels; 0 for anything else.
int side_from(const std::string& text) {
  const double side = parse_number(text).value_or(0.0);
  return side >= kSmallestSide && side <= kLargestSide && std::fmod(side, 2.0) == 0.0 ? static_cast<int>(side)
                                                                                      : 0;
}

Size size_from(const std::string& text) {
  const std::size_t cross = std::min(text.find('x'), text.size() - 1);
  const Size size{side_from(text.substr(0, cross)), side_from(text.substr(cross + 1))};
  if (size.width == 0 || size.height == 0) {
    throw InputError({"", 0, "--size"}, "\"" + text + "\"",
                     fmt::format("WIDTHxHEIGHT, both even, {} to {}", kSmallestSide, kLargestSide));
  }
  return size;
}

bool is_video(const Options& options) { return fs::path(options.out).extension() == ".mp4"; }

void check(const Options& options) {
  if (options.trial.empty() == options.trace.empty()) {
    throw InputError({"", 0, "render"},
                     options.trial.empty() ? "neither TRIAL nor --trace" : "both TRIAL and --trace",
                     "one of them");
  }
  if (!options.trace.empty() && (options.model.empty() || options.measured)) {
    throw InputError(
        {"", 0, "--trace"}, options.model.empty() ? "no --model" : "--measured",
        options.model.empty() ? "the model whose trace it is" : "a trial, which has measurements");
  }
  const std::string extension = fs::path(options.out).extension().string();
  if (extension != ".png" && extension != ".mp4") {
    throw InputError({options.out, 0, "--out"}, "extension \"" + extension + "\"", ".png or .mp4");
  }
  if (is_video(options) && (!options.at.empty() || options.strip > 0)) {
    throw InputError({options.out, 0, "--out"}, "a video of a single picture (--at, --strip)", "a .png");
  }
  if (!options.at.empty() && options.strip > 0) {
    throw InputError({"", 0, "--strip"}, "--at", "--from and --to");
  }
  check_writable(options.out);
  check_writable(options.json);
  check_not_an_input(options.out, {options.trace, options.model});
  check_not_an_input(options.json, {options.trace, options.model});
}

Scene from_trace(const Options& options) {
  Scene scene;
  scene.model = model::read_model(options.model, model::known_effects());
  scene.plant =
      std::make_unique<model::Plant>(scene.model, std::vector<model::Lock>(), terrain_of(options.platforms));
  scene.motion = render::motion_from(read_table(options.trace), *scene.plant);
  if (scene.motion.phase.empty()) {
    scene.phase_names = render::phases_by_contact(scene.model, scene.motion);
  }
  return scene;
}

Scene from_trial(const Options& options) {
  const std::string file = options.model.empty() ? validation::model_of_trial(options.trial) : options.model;
  Scene scene;
  scene.model = model::read_model(file, model::known_effects());
  const validation::Trial trial = validation::read_trial(options.trial, scene.model, {options.data_folder});
  check_not_an_input(options.out, {trial.data_file, trial.file});
  scene.plant = std::make_unique<model::Plant>(
      scene.model, trial.locks, options.platforms.empty() ? trial.terrain : terrain_of(options.platforms));
  const validation::TrialMotion motion =
      validation::trial_motion(scene.model, trial, {options.whole ? 0.0 : options.window, &stop_flag()});
  scene.motion = {motion.time, motion.predicted, motion.foot_forces, {}};
  scene.phase_names = render::phases_by_contact(scene.model, scene.motion);
  scene.measured = {motion.time, motion.measured, {}, {}};
  scene.notes.push_back(trial.title);
  scene.notes.push_back(options.whole ? "model in one piece from the first sample"
                                      : fmt::format("model in windows of {:g} s", options.window));
  return scene;
}

render::FilmOptions film_options(const Options& options, const Scene& scene, const Snapshots& motion) {
  render::FilmOptions film;
  film.title = scene.model.robot;
  film.notes = scene.notes;
  film.phase_names = scene.phase_names;
  film.camera = render::camera_named(options.camera);
  const Size size = size_from(options.size);
  film.width = size.width;
  film.height = size.height;
  film.exaggeration = options.exaggeration;
  film.from = options.from.empty() ? motion.begin() : time_from("--from", options.from);
  film.to = options.to.empty() ? motion.end() : time_from("--to", options.to);
  const double slack = 1e-9;
  const auto inside = [&](const std::string& option, double time) {
    if (!(time >= motion.begin() - slack && time <= motion.end() + slack)) {
      throw InputError({"", 0, option}, fmt::format("{:g} s", time),
                       fmt::format("a time of the motion, {:g} to {:g} s", motion.begin(), motion.end()));
    }
  };
  inside("--from", film.from);
  inside("--to", film.to);
  if (!options.at.empty()) {
    const double at = time_from("--at", options.at);
    inside("--at", at);
    film.at = at;
  }
  if (!(film.to > film.from)) {
    throw InputError({"", 0, "--to"}, fmt::format("{:g} s", film.to), "a time after --from");
  }
  return film;
}

struct Result {
  std::string file;
  int frames = 1;
};

Result film_video(render::Film& film, const Options& options, const render::FilmOptions& range) {
  const double seconds = (range.to - range.from) * options.slow;
  if (seconds > kLongestVideo) {
    throw InputError({"", 0, "--slow"}, fmt::format("a video of {:g} s", seconds), "at most an hour");
  }
  const int frames = std::max(1, static_cast<int>(std::lround(seconds * options.rate)));
  render::Video video(options.out, range.width, range.height, options.rate);
  ProgressLine line;
  const validation::Progress show = line.callback();
  for (int k = 0; k < frames; ++k) {
    if (stop_flag().raised) {
      throw validation::Stopped();
    }
    show(fmt::format("frame {} of {}", k + 1, frames), static_cast<double>(k) / frames);
    video.add(film.frame(range.from + k / (options.rate * options.slow)));
  }
  return {video.finish(), frames};
}

Result paint(const Options& options, const Scene& scene, const render::Figure& figure) {
  const Snapshots motion(*scene.plant, scene.motion);
  std::optional<Snapshots> measured;
  if (options.measured) {
    measured.emplace(*scene.plant, scene.measured);
  }
  render::FilmOptions film_of = film_options(options, scene, motion);
  const render::VirtualDisplay display;
  if (options.strip > 0) {
    render::write_png(render::strip(figure, *scene.plant, motion, options.strip, film_of), options.out);
    return {options.out, 1};
  }
  if (is_video(options) && options.slow != 1.0) {
    film_of.notes.push_back(options.slow > 1.0
                                ? fmt::format("{:g} times slower than real", options.slow)
                                : fmt::format("{:g} times faster than real", 1.0 / options.slow));
  }
  render::Film film(figure, *scene.plant, motion, measured ? &*measured : nullptr, film_of);
  if (is_video(options)) {
    return film_video(film, options, film_of);
  }
  render::write_png(film.frame(film_of.at.value_or(film_of.from)), options.out);
  return {options.out, 1};
}

void run(const Options& options) {
  check(options);
  size_from(options.size);
  const auto begin = std::chrono::steady_clock::now();
  const Scene scene = options.trial.empty() ? from_trace(options) : from_trial(options);
  const render::Figure figure =
      render::figure_of(scene.model, model::read_visuals(scene.model.skeleton.file));
  for (const std::string& message : figure.messages) {
    fmt::print(stderr, "plumbline: {}\n", message);
  }
  const Result result = paint(options, scene, figure);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_json(
      {{"file", result.file}, {"frames", result.frames}, {"seconds", seconds}, {"messages", figure.messages}},
      options.json);
  fmt::print("{}: {} {} in {:.1f} s\n", result.file, result.frames, result.frames == 1 ? "picture" : "frames",
             seconds);
}

void add_choices(CLI::App& command, Options& options) {
  command.add_option("--at", options.at, "the moment of a still, such as 1.2s")->type_name("TIME");
  command.add_option("--from", options.from, "first moment")->type_name("TIME");
  command.add_option("--to", options.to, "last moment")->type_name("TIME");
  command
      .add_option("--camera", options.camera, "side (still), follow (goes with the robot), boom (from above)")
      ->capture_default_str()
      ->check(CLI::IsMember({"side", "follow", "boom"}))
      ->type_name("NAME");
  command.add_option("--slow", options.slow, "slow motion: a second takes so many")
      ->capture_default_str()
      ->check(between(0.01, 1000.0));
  command.add_option("--fps", options.rate, "frames in a second of video")
      ->capture_default_str()
      ->check(between(1.0, 240.0));
  command.add_option("--size", options.size, "of the picture, pixels")
      ->capture_default_str()
      ->type_name("WxH");
  command.add_option("--strip", options.strip, "a still of so many stick figures from --from to --to")
      ->check(CLI::Range(2, 200));
  command.add_option("--exaggerate", options.exaggeration, "cable stretch is drawn so many times larger")
      ->check(between(0.01, 1e6));
  command
      .add_option("--platform", options.platforms,
                  "a step in the ground: from and to, height, m (again for more)")
      ->type_name("FROM TO HEIGHT");
}

}  // namespace

void add_render(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("render", "Draw a trial or a simulated motion: a still or a video");
  command->add_option("trial", options->trial, "trial folder (or its trial.yaml)")->type_name("TRIAL");
  command->add_option("--trace", options->trace, "trace of simulate in place of a trial; needs --model")
      ->type_name("FILE");
  command->add_option("--model", options->model, "model file in place of the one the trial names")
      ->type_name("FILE");
  command->add_option("--data", options->data_folder, "folder with the trial's data files")->type_name("DIR");
  command->add_option("-o,--out", options->out, "the picture (.png) or video (.mp4)")
      ->required()
      ->type_name("FILE");
  command->add_flag("--measured", options->measured, "the measured motion as a ghost beside the model");
  command->add_flag("--whole", options->whole, "simulate the trial in one piece, not in windows");
  command->add_option("--window", options->window, "length of the windows, s")
      ->capture_default_str()
      ->check(between(0.01, 1000.0));
  add_choices(*command, *options);
  add_json_option(*command, options->json);
  command->footer(
      "Example:\n  plumbline render demo/mimo --measured --whole --slow 2 -o mimo.mp4\n"
      "  plumbline render --trace hops.csv --model robots/mabel/mabel.yaml --at 1.2s -o hop.png");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
