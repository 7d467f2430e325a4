// An ASLIP from a file (`plumbline: aslip/1`).
#pragma once

#include <string>

#include "validation/studies/aslip/aslip.h"

namespace plumbline::validation {

struct AslipFile {
  AslipModel model;
  AslipReadings readings;
  SlipEmbedding gains;
};

/// Throws InputError.
AslipFile read_aslip(const std::string& path);

}  // namespace plumbline::validation
