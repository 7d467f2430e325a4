#include "validation/studies/running/published_running.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/model/yaml_node.h"
#include "simulator/trace/table.h"
#include "simulator/trace/units.h"
#include "validation/studies/running/monopod_file.h"
#include "validation/studies/running/return_map.h"
#include "validation/studies/running/running_file.h"

namespace plumbline::validation {
namespace {

// Names that gaits of other robots have here, too.
using model::YamlNode;
using monopod::Constants;
using monopod::Gait;
using monopod::kLegShape;
using monopod::kMotor;
using monopod::kTorso;
using monopod::Phase;
using monopod::Section;
using Sign = model::QuantityRule::Sign;
using Relation = PublishedQuantity::Relation;

constexpr const char* kFormat = "published_running/1";
constexpr double kSameConstant = 1e-6;  // relative: files are written with ten digits
constexpr std::size_t kLate = 5;        // touchdowns after the push from which the contraction is taken

const std::map<std::string, std::string>& measures() {
  static const std::map<std::string, std::string> all{{"stance", "s"},
                                                      {"flight", "s"},
                                                      {"pitch_at_touchdown", "rad"},
                                                      {"pitch_at_liftoff", "rad"},
                                                      {"motor_at_touchdown", "rad"},
                                                      {"motor_at_liftoff", "rad"},
                                                      {"multiplier", "1"},
                                                      {"multiplier_open", "1"},
                                                      {"contraction", "1"},
                                                      {"friction", "1"},
                                                      {"touchdown_friction", "1"},
                                                      {"least_normal", "N"},
                                                      {"angle_motor_torque", "N m"},
                                                      {"shape_motor_torque", "N m"}};
  return all;
}

PublishedRunning::Number read_number(const YamlNode& node) {
  node.allow_keys({"name", "measure", "value", "at_most", "at_least", "tolerance"});
  PublishedRunning::Number one;
  one.name = node.at("name").text();
  one.measure = node.at("measure").text();
  const auto known = measures().find(one.measure);
  if (known == measures().end()) {
    std::vector<std::string> names;
    for (const auto& [name, unit] : measures()) {
      names.push_back(name);
    }
    throw InputError(node.at("measure").place(), "no such measure",
                     "a measure" + nearest_names(one.measure, names));
  }
  const std::string& unit = known->second;
  int stated = 0;
  const std::pair<const char*, Relation> relations[] = {
      {"value", Relation::value}, {"at_most", Relation::at_most}, {"at_least", Relation::at_least}};
  for (const auto& [key, relation] : relations) {
    if (const auto value = node.find(key)) {
      one.relation = relation;
      one.quantity = model::read_quantity(*value, {unit, Sign::any, false, {}});
      ++stated;
    }
  }
  if (stated != 1) {
    node.refuse("exactly one of value, at_most, at_least");
  }
  one.tolerance = model::read_quantity(node.at("tolerance"), {unit, Sign::not_negative, false, {}});
  return one;
}

std::vector<double> column(const Table& table, std::size_t index) {
  const Eigen::VectorXd& v = table.columns[index].values;
  return {v.data(), v.data() + v.size()};
}

Table two_columns(const YamlNode& node) {
  Table table = read_csv(model::beside(node.file(), node.text()));
  if (table.columns.size() != 2) {
    node.refuse("a table with two columns");
  }
  return table;
}

PublishedRunning::Shape read_shape(const YamlNode& node) {
  node.allow_keys({"name", "of", "file", "tolerance", "source"});
  PublishedRunning::Shape shape;
  shape.name = node.at("name").text();
  shape.of = node.at("of").text();
  const std::vector<std::string> known{"pitch", "motor", "ahead", "shape"};
  if (std::find(known.begin(), known.end(), shape.of) == known.end()) {
    node.at("of").refuse("one of pitch, motor, ahead, shape");
  }
  const Table table = two_columns(node.at("file"));
  shape.curve.time = column(table, 0);
  shape.curve.value = column(table, 1);
  const model::Quantity tolerance =
      model::read_quantity(node.at("tolerance"), {table.columns[1].unit, Sign::positive, false, {}});
  shape.curve.tolerance = tolerance.value;
  shape.unit = tolerance.unit;
  shape.source = node.at("source").text();
  return shape;
}

PublishedRunning::Recovery read_recovery(const YamlNode& node) {
  node.allow_keys({"angle", "rate", "speed", "mirrored", "pitch_error", "speed_error", "pitch_tolerance",
                   "speed_tolerance", "source"});
  PublishedRunning::Recovery r;
  r.angle = model::read_quantity(node.at("angle"), {"rad", Sign::any, false, {}}).value;
  r.rate = model::read_quantity(node.at("rate"), {"rad/s", Sign::any, false, {}}).value;
  const double x = node.at("mirrored").flag() ? -1.0 : 1.0;
  r.rise = model::read_quantity(node.at("speed"), {"m/s", Sign::any, false, {}}).value;
  r.forward = x * r.rise;
  r.pitch = column(two_columns(node.at("pitch_error")), 1);
  r.travel = column(two_columns(node.at("speed_error")), 1);
  for (double& error : r.travel) {
    error *= x;
  }
  r.pitch_tolerance = model::read_quantity(node.at("pitch_tolerance"), {"rad", Sign::positive, false, {}});
  r.forward_tolerance = model::read_quantity(node.at("speed_tolerance"), {"m/s", Sign::positive, false, {}});
  r.source = node.at("source").text();
  return r;
}

void require_the_same(const PublishedRunning& published) {
  Constants robot = published.model, controller = published.running.model;
  for (const std::string& name : constant_names()) {
    const double a = *constant_by_name(robot, name), b = *constant_by_name(controller, name);
    if (!(std::abs(a - b) <= kSameConstant * std::max(std::abs(a), std::abs(b)))) {
      throw InputError({published.controller_file, 0, "constants: " + name}, std::to_string(b),
                       std::to_string(a) + " as in " + published.model_file);
    }
  }
}

/// All that is run, once.
class Runner {
 public:
  explicit Runner(const PublishedRunning& published) : p_(published) {
    run_nominal();
    map_ = linear_return(p_.model, gait(), kIntegrationStep);
    push();
  }

  Verdict judge(const PublishedRunning::Number& number) const {
    Verdict verdict;
    verdict.name = number.name;
    verdict.measure = number.measure;
    verdict.source = number.quantity.source;
    verdict.unit = number.quantity.unit;
    verdict.relation = number.relation;
    verdict.published = number.quantity.value;
    verdict.tolerance = number.tolerance.value;
    verdict.simulated = Spread{measured(number.measure), 0.0, 1};
    PublishedQuantity as;
    as.relation = number.relation;
    as.quantity = number.quantity;
    as.tolerance = number.tolerance;
    verdict.outside = as.outside(verdict.simulated->mean);
    return verdict;
  }

  Verdict judge(const PublishedRunning::Shape& shape) const {
    double sum = 0.0;
    long count = 0;
    const bool flies = shape.of == "ahead" || shape.of == "shape";
    const double begin = flies ? facts_.stance : 0.0;
    for (const HybridSample& sample : samples_) {
      const double t = sample.time - begin;
      if ((sample.phase == Phase::flight) != flies || t < shape.curve.time.front() ||
          t > shape.curve.time.back()) {
        continue;
      }
      const double value = shape.of == "pitch"   ? sample.state.q[kTorso]
                           : shape.of == "motor" ? sample.state.q[kMotor]
                           : shape.of == "ahead" ? sample.com[0] - sample.toe[0]
                                                 : sample.state.q[kLegShape];
      sum += std::pow(value - shape.curve.at(t), 2);
      ++count;
    }
    return of_rms(shape.name, "rms difference of " + shape.of, shape.source, shape.unit,
                  std::sqrt(sum / static_cast<double>(count)), shape.curve.tolerance, count);
  }

  Verdict pitch() const {
    return of_recovery("pitch after the push", 2, p_.recovery.pitch, p_.recovery.pitch_tolerance);
  }
  Verdict forward() const {
    return of_recovery("speed after the push", 6, p_.recovery.travel, p_.recovery.forward_tolerance);
  }
  double period() const { return facts_.stance + facts_.flight; }

 private:
  const Gait& gait() const { return p_.running.gait; }

  void run_nominal() {
    HybridRun run(monopod::Running(p_.model, gait()), kIntegrationStep);
    run.record = &samples_;
    run.state = state_at(p_.model, gait().section);
    if (!run.stand() || !run.fly()) {
      throw InputError({p_.controller_file, 0, ""}, "a motion that falls within one stride",
                       "a periodic running motion");
    }
    facts_ = run.facts;
  }

  void push() {
    Section start = gait().section;
    start.head<3>().array() += p_.recovery.angle;
    start.segment<3>(3).array() += p_.recovery.rate;
    start[6] += p_.recovery.forward;
    start[7] += p_.recovery.rise;
    pushed_ =
        touchdowns(p_.model, gait(), start, static_cast<int>(p_.recovery.travel.size()), kIntegrationStep);
  }

  double measured(const std::string& measure) const {
    const std::map<std::string, double> simple{
        {"stance", facts_.stance},
        {"flight", facts_.flight},
        {"pitch_at_touchdown", gait().section[2]},
        {"pitch_at_liftoff", facts_.torso_at_liftoff},
        {"motor_at_touchdown", p_.model.shape_ratio * gait().section[1]},
        {"motor_at_liftoff", facts_.motor_at_liftoff},
        {"friction", facts_.most_friction},
        {"touchdown_friction", std::abs(facts_.impulse_ratio)},
        {"least_normal", facts_.least_normal},
        {"angle_motor_torque", facts_.most_torque[0]},
        {"shape_motor_torque", facts_.most_torque[1]}};
    const auto found = simple.find(measure);
    if (found != simple.end()) {
      return found->second;
    }
    if (measure == "multiplier") {
      return multipliers(map_.by_state).front();
    }
    if (measure == "multiplier_open") {
      return multipliers(map_.by_state - map_.by_beta * gait().gain).front();
    }
    // Mean ratio of the speed's error from one touchdown to the next.
    if (pushed_.size() < kLate + 2) {
      return std::numeric_limits<double>::infinity();
    }
    const double first = pushed_[kLate][6] - gait().section[6];
    const double last = pushed_.back()[6] - gait().section[6];
    return std::pow(std::abs(last / first), 1.0 / static_cast<double>(pushed_.size() - 1 - kLate));
  }

  static Verdict of_rms(const std::string& name, const std::string& measure, const std::string& source,
                        const std::string& unit, double rms, double tolerance, long count) {
    Verdict verdict;
    verdict.name = name;
    verdict.measure = measure;
    verdict.source = source;
    verdict.unit = unit;
    verdict.relation = Relation::at_most;
    verdict.tolerance = tolerance;
    verdict.simulated = Spread{rms, 0.0, 1};
    verdict.outside = std::max(0.0, rms - tolerance);
    verdict.remark = std::to_string(count) + " points";
    return verdict;
  }

  Verdict of_recovery(const std::string& name, int component, const std::vector<double>& wanted,
                      const model::Quantity& tolerance) const {
    double sum = 0.0;
    const std::size_t count = std::min(wanted.size(), pushed_.size());
    for (std::size_t k = 0; k < count; ++k) {
      const double off = pushed_[k][component] - gait().section[component];
      // The figure of the pitch shows its size.
      sum += std::pow((component == 2 ? std::abs(off) : off) - wanted[k], 2);
    }
    Verdict verdict =
        of_rms(name, "rms difference at the touchdowns", p_.recovery.source, tolerance.unit,
               std::sqrt(sum / static_cast<double>(count)), tolerance.value, static_cast<long>(count));
    if (count < wanted.size()) {
      verdict.simulated.reset();
      verdict.remark = "falls after " + std::to_string(count) + " touchdowns";
    }
    return verdict;
  }

  const PublishedRunning& p_;
  std::vector<HybridSample> samples_;
  StrideFacts facts_;
  LinearReturn map_;
  std::vector<Section> pushed_;
};

}  // namespace

bool is_published_running(const std::string& path) {
  const auto format = YamlNode::load(path).find("plumbline");
  return format && format->text() == kFormat;
}

PublishedRunning read_published_running(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  model::check_format(root, kFormat);
  root.allow_keys({"plumbline", "title", "monopod", "controller", "quantities", "curves", "recovery"});
  PublishedRunning published;
  published.file = path;
  published.title = root.at("title").text();
  const MonopodModel robot = read_monopod(model::beside(path, root.at("monopod").text()));
  published.model_file = robot.names.model;
  published.model = robot.constants;
  published.controller_file = model::beside(path, root.at("controller").text());
  published.running = read_running(published.controller_file);
  for (const YamlNode& item : root.at("quantities").items()) {
    published.numbers.push_back(read_number(item));
  }
  for (const YamlNode& item : root.at("curves").items()) {
    published.shapes.push_back(read_shape(item));
  }
  published.recovery = read_recovery(root.at("recovery"));
  require_the_same(published);
  return published;
}

GaitValidation validate_running(const PublishedRunning& published) {
  const Runner runner(published);
  GaitValidation done;
  done.gait = "running";
  done.title = published.title;
  for (const auto& number : published.numbers) {
    done.verdicts.push_back(runner.judge(number));
  }
  for (const auto& shape : published.shapes) {
    done.verdicts.push_back(runner.judge(shape));
  }
  done.verdicts.push_back(runner.pitch());
  done.verdicts.push_back(runner.forward());
  done.duration = runner.period();
  return done;
}

}  // namespace plumbline::validation
