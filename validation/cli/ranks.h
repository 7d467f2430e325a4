// The ranks of an MPI job, when the program was started as one of them.
#pragma once

#include <string>
#include <vector>

#include "work/workers.h"

namespace plumbline::cli {

/// The program's version, and what it can do long work with: "0.1.0 (Open MPI v4.1.4)".
std::string version_text();

/// To be called before anything else; silences all ranks but the first. Throws work::Failed when this process
/// is one of several but has no MPI, or when their programs differ.
void start_ranks();

/// Of this process; threads alone where it was started alone.
work::Workers& workers();

/// Throws work::Refused where ranks read other bytes from these files than the first one does.
void check_same_files(const std::vector<std::string>& files);

/// Is there nothing for this rank to do? All ranks take part in the commands whose work is shared; any other
/// command is done by the first one, which says so.
bool is_left_out(const std::vector<std::string>& words);

}  // namespace plumbline::cli
