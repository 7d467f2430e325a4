// Files that a command is going to write, checked before any work is done.
#pragma once

#include <string>
#include <vector>

#include "simulator/trace/table.h"
#include "validation/report/json_number.h"

namespace plumbline::cli {

/// Throws InputError when `file` could not be written; leaves nothing behind. Empty: nothing is checked.
void check_writable(const std::string& file);

/// Refuses a folder that could not be made later. An empty name passes.
void check_new_folder(const std::string& folder);

/// The same for the file of a trace, which also must be named .csv or .mat.
void check_trace_file(const std::string& file);
void write_trace(const Table& trace, const std::string& file);

/// Throws InputError when `file` is one of the `inputs`.
void check_not_an_input(const std::string& file, const std::vector<std::string>& inputs);

using validation::json_number;

}  // namespace plumbline::cli
