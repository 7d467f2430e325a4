// A run of a gait as bytes, so that it can travel from one rank to the others.
#pragma once

#include "validation/control/gait/gait_run.h"
#include "work/bytes.h"

namespace plumbline::validation {

/// How the run ended, its energies and its cycles, to the last bit. Not what the integrator says of itself,
/// the wall time and the tables of samples: they stay where the run was made.
void add(const GaitRun& run, work::Bytes& bytes);
GaitRun gait_run_from(work::BytesReader& reader);

}  // namespace plumbline::validation
