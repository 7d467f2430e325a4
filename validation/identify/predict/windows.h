// Windows of trials, and the prediction of one window from an initial state with all its derivatives.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulator/integrate/held_commands.h"
#include "simulator/integrate/integrator.h"
#include "simulator/integrate/plate_means.h"
#include "simulator/model/plant.h"
#include "simulator/model/positions_from.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

/// Samples first ... first + count - 1 of a trial, predicted from their own initial state.
struct Window {
  int trial = 0;
  Eigen::Index first = 0;
  Eigen::Index count = 0;
  std::vector<int> events{};  ///< of the trial's contact events those inside
  bool continues = false;     ///< a segment that begins where the one before it ends, maybe in contact
};

/// A window through stance begins this long before touchdown and ends this long after lift-off, s.
constexpr double kLead = 0.025;
constexpr double kTail = 0.01;

struct PredictOptions {
  double window = 0.5;              ///< s
  double relative_tolerance = 0.0;  ///< of the integrator; 0: as the sensors' floors ask (tolerance.h)
  double history = 1.0;  ///< s of measured motion before a window over which hidden states are carried;
                         ///< longer where more than a thousandth of what they were then would be left
  /// Integrator steps for each sample, mean over what was run of a window and a fifth of it (at least 20
  /// samples); a law that needs more: std::runtime_error.
  double most_steps = std::numeric_limits<double>::infinity();
  /// explicit_rk runs at order 3: one step for each held sample, four evaluations, errors far below any
  /// encoder's count. A model whose feet meet a ground takes rosenbrock in its place, and so does a window in
  /// which the explicit method needs many steps (dry friction that holds).
  integrate::Method method = integrate::Method::explicit_rk;
  /// Derivatives by differences of whole predictions: slower, and right wherever the linearisation of a piece
  /// is not.
  bool differences = false;
};

/// Cuts every trial into equal windows of about options.window, never across an event or a gap; a rest
/// shorter than half a window joins its neighbour. With contact switches it is cut in each flight, kTail
/// after lift-off and kLead before touchdown, and its windows come in the order stance, flight. Of a trial
/// with a start only windows that begin in a flight are kept. Throws InputError when a trial has fewer
/// samples than one window, or a start and no flight.
std::vector<Window> cut_windows(const std::vector<Trial>& trials, const PredictOptions& options);

/// The window in segments (multiple shooting; Bock, "Numerical treatment of inverse problems in chemical
/// reaction kinetics", 1981): cut in two, and these again, until none is longer than one and a half times
/// `length` s or would be shorter than the shortest window. A cut is made within a tenth of the middle, as
/// far as it can be from where a contact switch changes. Segments of a shorter length lie within those of a
/// longer one. Of a trial with a start the first alone: where the others begin no sensor tells.
std::vector<Window> segments_of(const Window& window, const Trial& trial, double length);

/// The first `share` of the window, at least two samples, with the contact events in it.
Window beginning_of(const Window& window, const Trial& trial, double share);

/// One parameter that may move.
struct FreeParameter {
  model::ParameterId id;
  std::string label;  ///< "viscous@mLA:damping"
  std::string unit;
  effects::Scale scale = effects::Scale::linear;
  double lower = 0.0, upper = 0.0;  ///< in the parameter's own unit
  double typical = 1.0;
  double mean = 0.0;                                           ///< what is known of it beforehand
  double deviation = std::numeric_limits<double>::infinity();  ///< and how well; infinite: not at all
  std::vector<model::ParameterId> also{};                      ///< parameters that always have the same value
  bool physical = false;  ///< the bounds say what the robot can be: a value at one is none
  /// At the bound the law leaves the model with its hidden states: from there no slope leads back.
  bool leaves_at_bound = false;
  /// How what is known of it hangs together with what is known of others, by their labels; null: not at all.
  std::shared_ptr<const model::Correlations> together{};

  void set(model::Plant& plant, double value) const;
};

/// The window's residual r = (measured - predicted) / floor, channel by channel within each sample, behind
/// them the instants of the window's contact events, and
/// Jx = d(predicted)/d(x0) / floor, Jp = d(predicted)/d(parameters) / floor.
struct Linearisation {
  Eigen::VectorXd r;
  Eigen::MatrixXd Jx, Jp;
};

/// What a trial says of the independent positions: its position sensors, then its start.
std::vector<model::Observation> start_observations(const model::Plant& plant, const Trial& trial);

/// Predicts windows of one trial with one model. Owns a Plant: one object for each thread.
class Predictor {
 public:
  Predictor(const model::Model& model, const Trial& trial, const PredictOptions& options);

  model::Plant& plant() { return plant_; }
  int channels() const { return static_cast<int>(sensor_of_channel_.size()); }
  const Eigen::VectorXd& floors() const { return floors_; }

  /// State at the window's start from the measurements alone: positions by weighted least squares over the
  /// first samples' local polynomials, unseen stretches zero, actuators settled, bristles relaxed.
  /// What no sensor shows is where Trial::start says, at rest; in a flight that contact switches show it
  /// falls freely from there, at the height at which the foot touches down when the switch says. A prediction
  /// does not start from these bristles: it carries them along the measured motion up to the window with the
  /// parameters of the moment. Free in each window they would be a force of their own, and a friction law
  /// would explain whatever is constant over a window.
  Eigen::VectorXd initial_state(const Window& window);
  /// Where to begin the search of the initial state: initial_state(), and where a plate shows the touchdown
  /// the best of its neighbours that land up to kEarlier sooner or later. An impact lasts less than a sample
  /// of a plate, and what a sample shows of it changes within a tenth of that.
  Eigen::VectorXd search_start(const Window& window);
  /// One standard deviation within which the initial state is expected around initial_state(), x.
  Eigen::VectorXd spread_around(const Eigen::VectorXd& x) const;
  /// How far x0 is from initial_state(), in units of its spread, and the slope of that: behind the window's
  /// residual r as further residuals. Where the trial's start is what is known, it counts against the model's
  /// error as against noise: the spread is then one root mean square of r, and no start is moved far to make
  /// up for physics that the model has not.
  struct Anchor {
    Eigen::VectorXd r, slope;  ///< weight (expected - x0), weight
  };
  Anchor anchor(const Window& window, const Eigen::VectorXd& x0, const Eigen::VectorXd& r);

  /// Predicted channels, count x channels, SI. A prediction that is ten times the channel's whole range in
  /// the trial and ten thousand floors away says no more of the motion, and may take long to compute: from
  /// there it is held where it is, and has no slopes.
  Eigen::MatrixXd predict(const Window& window, const Eigen::VectorXd& x0);
  /// States of the window predicted last at its samples, states x count.
  Eigen::MatrixXd predicted_states() const;
  /// Independent positions that fit the measured channels best, positions x samples of the trial.
  Eigen::MatrixXd measured_positions() const;
  /// Residuals only.
  Eigen::VectorXd residual(const Window& window, const Eigen::VectorXd& x0);
  /// Those of which the sum of squares is at most `most`; none as soon as the first samples alone have more.
  std::optional<Eigen::VectorXd> residual_within(const Window& window, const Eigen::VectorXd& x0,
                                                 double most);
  Linearisation linearise(const Window& window, const Eigen::VectorXd& x0,
                          const std::vector<FreeParameter>& parameters);
  /// Residuals of a window: samples x channels, then contact events.
  Eigen::Index rows(const Window& window) const;
  /// Sums of squares by channel, then by contact switch.
  Eigen::VectorXd squares(const Window& window, const Eigen::VectorXd& residual) const;
  /// Is the window predicted last far from linear in where it begins? Through touchdown and lift-off, and
  /// where the model has stops or play.
  bool is_curved() const { return !trial_.switches.empty() || !jumps_.empty(); }
  /// What an error of one deviation in a position at the window's start becomes at most in the channels that
  /// show positions, in floors: about 1 where errors stay as they are. Through stiff contacts it may be
  /// thousands, and the linearisation then holds for errors far below a floor only.
  double expansion(const Window& window, const Eigen::MatrixXd& Jx) const;
  /// Rate evaluations so far.
  long evaluations() const { return evaluations_; }

 private:
  /// Where a foot's predicted depth changes its sign.
  struct Crossing {
    Eigen::Index node = -1;  // behind which it lies; -1: nowhere in the window
    double share = 0.0;      // of the piece
    double time = 0.0;       // s, after the window's first sample
    double rate = 0.0;       // of the depth, m/s
  };

  /// Nodes between which deviations are carried in one step.
  struct Piece {
    Eigen::Index from = 0, to = 0;
  };

  /// A node at which a switching function went through zero and a force jumped.
  struct JumpNode {
    Eigen::Index node = 0;
    model::Plant::Jump jump;
    int direction = 0;
  };

  /// False where it was left because the samples so far have a larger sum of squared residuals than `most`.
  bool run(const Window& window, const Eigen::VectorXd& x0,
           double most = std::numeric_limits<double>::infinity());
  bool run(const Window& window, const Eigen::VectorXd& x0, integrate::Method method, double most_steps,
           double most);
  integrate::Options tolerances(const Window& window);
  double square_of_sample(const Window& window, Eigen::Index sample);
  Eigen::MatrixXd predicted(const Window& window);
  Eigen::VectorXd residual_of_run(const Window& window);
  void average_plates(Eigen::Index sample, integrate::PlateMeans& plates, Eigen::VectorXd& y);
  void advance_in_pieces(integrate::Integrator& integrator, double end, double t0);
  void add_jumps(const std::vector<integrate::Event>& events, double t0);
  bool is_behind_jump(Eigen::Index node) const;
  void jump_slopes(Eigen::Index node, const std::vector<model::ParameterId>& ids,
                   const Eigen::VectorXd& steps, Eigen::MatrixXd& S);
  void jump_slopes(const JumpNode& at, const std::vector<model::ParameterId>& ids,
                   const Eigen::VectorXd& steps, Eigen::MatrixXd& S);
  void begin_nodes(const Window& window);
  bool is_near_ground(Eigen::Index node);
  void add_node(double time, const Eigen::VectorXd& state);  // s after the window's first sample
  void add_sample(Eigen::Index sample, const Eigen::VectorXd& state);
  Eigen::Index node_of(Eigen::Index sample) const;
  bool has_left(const Window& window, Eigen::Index sample);
  void hold(const Window& window, Eigen::Index sample);
  double node_time(Eigen::Index node) const;  // s after the window's first sample
  double length_of(Eigen::Index node) const;
  double length_of(const Piece& piece) const;
  void stay_in_phase(Eigen::Index first, Eigen::Index& from, Eigen::Index& to) const;
  std::vector<Crossing> crossings_of(const Window& window);
  Crossing nearest_crossing(int foot, double threshold, bool touchdown, double time, double farthest);
  void timing_residuals(const Window& window, Eigen::VectorXd& r);
  void timing_slopes(const Window& window, const std::vector<Crossing>& crossings, Eigen::Index node,
                     const Eigen::MatrixXd& before, const Eigen::MatrixXd& behind,
                     const std::vector<model::ParameterId>& ids, Linearisation& out);
  Linearisation linearise_tied(const Window& window, const Eigen::VectorXd& x0,
                               const std::vector<FreeParameter>& parameters);
  Linearisation linearise_by_differences(const Window& window, const Eigen::VectorXd& x0,
                                         const std::vector<FreeParameter>& parameters);
  void refresh_commands();
  std::vector<Piece> pieces_of(Eigen::Index sample, const std::vector<Crossing>& crossings);
  bool is_even(Eigen::Index from, Eigen::Index to, const std::vector<Crossing>& crossings);
  void tangent_at(const Window& window, Eigen::Index k, const Piece& piece,
                  const std::vector<model::ParameterId>& ids, const Eigen::VectorXd& steps,
                  Eigen::MatrixXd& A, Eigen::MatrixXd& B);
  void read_sensors(const Window& window, Eigen::Index sample, Eigen::VectorXd& y);
  const double* command_of_reading(const Window& window, Eigen::Index sample);
  void turn_slopes(const Eigen::VectorXd& residual, Eigen::Index sample, Eigen::MatrixXd& slopes) const;
  void find_point_sensors();
  Eigen::MatrixXd local_polynomial(const Window& window) const;
  Eigen::MatrixXd with_starts(const Eigen::MatrixXd& channels, bool rates) const;
  void fall_freely(const Window& window, Eigen::VectorXd& x);
  void touch_down_in_time(const Window& window, int foot, double touchdown, const Eigen::VectorXd& a,
                          Eigen::VectorXd& x);
  void measure_motion(Eigen::Index from, Eigen::Index to);
  void carry_hidden(const Window& window, double* x);
  const Eigen::MatrixXd& command_squares();
  double carry_from(Eigen::Index from, Eigen::Index to, const std::vector<int>& warm, double* x);
  void carry_losses(Eigen::Index to, double* x) const;
  Eigen::MatrixXd hidden_slopes(const Window& window, const std::vector<model::ParameterId>& ids,
                                const Eigen::VectorXd& steps);

  const Trial& trial_;
  PredictOptions options_;
  model::Plant plant_;
  std::vector<int> sensor_of_channel_;
  std::vector<Eigen::Index> position_channels_;  // those that show positions or poses
  std::vector<int> orientation_channels_;        // the first of the three of each orientation
  bool accelerometers_ = false;
  Eigen::VectorXd floors_;
  model::PositionsFrom from_channels_;
  Eigen::MatrixXd command_samples_;
  Eigen::VectorXd commands_before_;
  std::unique_ptr<integrate::HeldCommands> commands_;
  std::vector<double> lateness_;  // delays and clocks of which commands_ are
  Eigen::MatrixXd
      command_squares_;  // of the commands before each sample, summed; empty until they are needed
  Eigen::VectorXd reading_command_;  // of the last reading
  std::vector<int> foot_of_switch_;
  // Of the last run: states x nodes; a node is a sample or, with a ground and where a force jumps, a point
  // between two.
  Eigen::MatrixXd states_;
  Eigen::Index nodes_ = 0;
  std::vector<Eigen::Index> node_of_sample_;  // both empty where every node is a sample
  std::vector<double> node_times_;            // s, after the window's first sample
  Eigen::Index held_from_ = 0;                // the sample behind which the prediction is held, or the last
  Eigen::VectorXd farthest_;  // by channel: how far from the measurement a prediction is followed
  std::vector<model::Plant::Jump> jumps_;  // that the model's forces can make
  std::vector<JumpNode> jump_nodes_;       // that they made
  std::size_t events_seen_ = 0;
  Eigen::MatrixXd motion_;          // positions and velocities x samples, measured; empty until it is needed
  std::vector<bool> is_measured_;   // which samples of it are known
  Eigen::MatrixXd measured_rates_;  // channels x samples
  long evaluations_ = 0;
};

}  // namespace plumbline::validation
