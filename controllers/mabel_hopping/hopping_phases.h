// The phases of hopping (Figure S3 of the MABEL paper) and what leads from one to the next.
#pragma once

#include "controllers/mabel_hopping/hopping_config.h"

namespace plumbline::controllers {

/// The paper's phases, numbered for logs.
enum class HoppingPhase {
  flight = 1,         ///< I
  touchdown = 2,      ///< II
  kickoff = 3,        ///< III
  left_liftoff = 4,   ///< IVa
  right_liftoff = 5,  ///< IVb
  retract = 6,        ///< V
};

/// The paper's name: "I", "II", "III", "IVa", "IVb" or "V".
const char* to_string(HoppingPhase phase) noexcept;

/// A switch without its chatter: changes once the raw switch has differed for `samples` samples in a row.
class Debounce {
 public:
  explicit Debounce(int samples) noexcept : samples_(samples) {}
  bool update(bool raw) noexcept {
    differing_ = raw == closed_ ? 0 : differing_ + 1;
    if (differing_ >= samples_) {
      closed_ = raw;
      differing_ = 0;
    }
    return closed_;
  }

 private:
  int samples_;
  int differing_ = 0;
  bool closed_ = false;
};

/// The state machine, at most one transition a sample. It starts in phase I with open switches.
///
/// From the paper, with contact standing for p_toe <= 0:
///   I -> II      both feet down (S6)
///   II -> III    v > -band, v the hip's vertical velocity (S8). The paper's |v| < band lasts about 2 ms,
///                less than the encoder resolves: a velocity that has already crossed the band counts too.
///   III -> IVa, IVb, V   left foot up, right foot up, both feet up (S10 to S12)
///   IVa -> V, IVb -> V   the other foot up too (S14, S16)
///   V -> I       after retract_time (S17)
/// Ours, where the paper is silent:
///   II lasts at least touchdown_time_min, and III is not entered with both feet up.
///   II -> I      not both feet down for longer than bounce_time
///   III -> II    no foot up for kickoff_time_max: the legs give way and push again
///   IVa, IVb -> I   the second foot not up for liftoff_time_max: the lifted leg lands again
///   In I a single foot, or none, may be down for any time: the pose is held (a robot in its harness waits
///   like this), and whoever runs the controller decides when to give up, by time_in_phase().
///   Contact is not looked at in V, and a foot that touches again in IVa or IVb changes nothing.
///   A landing is an I -> II after both feet were off (V), or the first: a bounce is none.
class HoppingPhases {
 public:
  /// Expects a valid configuration.
  explicit HoppingPhases(const HoppingConfig& config) noexcept;

  /// One sample: raw contact switches and the hip's vertical velocity in m/s, up positive.
  HoppingPhase update(bool left_contact, bool right_contact, double hip_velocity) noexcept;

  HoppingPhase phase() const noexcept { return phase_; }
  /// Landings so far.
  long landings() const noexcept { return landings_; }
  /// Samples since the transition into this phase; 0 at it.
  long samples_in_phase() const noexcept { return samples_in_phase_; }

 private:
  HoppingPhase after_flight(bool left, bool right) const noexcept;
  HoppingPhase after_touchdown(bool left, bool right, double hip_velocity) const noexcept;
  HoppingPhase after_kickoff(bool left, bool right) const noexcept;
  HoppingPhase after_liftoff(bool other) const noexcept;
  HoppingPhase after_retract() const noexcept;
  HoppingPhase next(bool left, bool right, double hip_velocity) const noexcept;
  void enter(HoppingPhase phase) noexcept;

  double band_;
  long touchdown_min_, bounce_, kickoff_max_, liftoff_max_, retract_;  // samples
  Debounce left_, right_;
  HoppingPhase phase_ = HoppingPhase::flight;
  long samples_in_phase_ = 0;
  long samples_bounced_ = 0;  // in a row, without both feet down
  bool flown_ = true;         // both feet off since the last landing, or never landed
  long landings_ = 0;
};

}  // namespace plumbline::controllers
