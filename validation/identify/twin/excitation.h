// The shapes of commands that excite a robot. Numbers in, numbers out: no files, no units.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace plumbline::validation {

/// The sample times k T, k = 0 .. count-1, of a command held over each sample.
struct Sampling {
  double period = 1e-3;    ///< T, s
  Eigen::Index count = 0;  ///< samples
  double duration() const { return static_cast<double>(count) * period; }
};

/// One shape. Levels and amplitudes are in the command's own unit, frequencies in Hz, phases in rad, times
/// in s from the start of the experiment. Constructors throw std::invalid_argument when the shape is
/// impossible (lists of different lengths, a frequency that is not positive, times that do not rise).
class Excitation {
 public:
  virtual ~Excitation() = default;
  /// Adds the shape to `command`, which has sampling.count values.
  virtual void add_to(Eigen::VectorXd& command, const Sampling& sampling) const = 0;
  /// The highest frequency that the shape is made of, Hz; 0 when it has none. Below 1/(2 T) the samples
  /// still show it.
  virtual double highest_frequency() const { return 0.0; }
};

using Excitations = std::vector<std::unique_ptr<Excitation>>;

/// The sum of all shapes, sampled.
Eigen::VectorXd sampled_sum(const Excitations& shapes, const Sampling& sampling);

class Constant : public Excitation {
 public:
  explicit Constant(double value) : value_(value) {}
  void add_to(Eigen::VectorXd& command, const Sampling& sampling) const override;

 private:
  double value_;
};

/// A sine whose frequency and amplitude are constant over each of `steps` equal shares of the experiment:
///   f_i = from (to/from)^(i/(steps-1)), i = 0 .. steps-1
///   a_i = first (last/first)^(i/(steps-1)), or first + (last - first) i/(steps-1) with linear amplitudes
///   u(t) = a_i sin(phase), d(phase)/dt = 2 pi f_i, phase(0) = 0
/// The phase goes on across the steps, so that only the slope jumps where the amplitude's step is small.
/// Source: the modified chirp of Park et al., Figure 11 and section Transmission Identification; the equal
/// shares and the spacing are ours.
class SteppedChirp : public Excitation {
 public:
  struct Options {
    double from = 0.0, to = 0.0;  ///< Hz, > 0
    int steps = 0;                ///< >= 2
    double first_amplitude = 0.0, last_amplitude = 0.0;
    bool linear_amplitude = false;  ///< false: both amplitudes must be positive
  };
  explicit SteppedChirp(const Options& options);
  void add_to(Eigen::VectorXd& command, const Sampling& sampling) const override;
  double highest_frequency() const override;

  double frequency(int step) const;
  double amplitude(int step) const;

 private:
  Options options_;
};

/// u(t) = sum_i a_i sin(2 pi f_i t + phase_i)
class Multisine : public Excitation {
 public:
  Multisine(std::vector<double> frequencies, std::vector<double> amplitudes, std::vector<double> phases);
  void add_to(Eigen::VectorXd& command, const Sampling& sampling) const override;
  double highest_frequency() const override;

 private:
  std::vector<double> frequencies_, amplitudes_, phases_;
};

/// levels[i] from times[i] until times[i+1]; 0 before times[0], the last level to the end.
class Steps : public Excitation {
 public:
  Steps(std::vector<double> times, std::vector<double> levels);
  void add_to(Eigen::VectorXd& command, const Sampling& sampling) const override;

 private:
  std::vector<double> times_, levels_;
};

/// From level `start` at the first sample in a straight line to `end` at the last.
class Ramp : public Excitation {
 public:
  Ramp(double start, double end) : start_(start), end_(end) {}
  void add_to(Eigen::VectorXd& command, const Sampling& sampling) const override;

 private:
  double start_, end_;
};

/// `level` for `width` seconds from each of the times, otherwise 0.
class Pulses : public Excitation {
 public:
  Pulses(std::vector<double> times, double width, double level);
  void add_to(Eigen::VectorXd& command, const Sampling& sampling) const override;

 private:
  std::vector<double> times_;
  double width_, level_;
};

/// White noise behind a first-order low-pass of corner frequency `corner`:
///   u_(k+1) = a u_k + deviation sqrt(1 - a^2) n_k, a = exp(-2 pi corner T), n_k standard normal,
/// which has the standard deviation `deviation` at every sample, the first included.
class FilteredNoise : public Excitation {
 public:
  FilteredNoise(double deviation, double corner, std::uint64_t seed);
  void add_to(Eigen::VectorXd& command, const Sampling& sampling) const override;

 private:
  double deviation_, corner_;
  std::uint64_t seed_;
};

}  // namespace plumbline::validation
