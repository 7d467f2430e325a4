// Closed loops of an MJCF file: <equality> with <connect> and <weld>.
#pragma once

#include <tinyxml2.h>

#include <string>

#include "simulator/model/mjcf_document.h"
#include "simulator/model/model.h"

namespace plumbline::model {

/// Is this element of <equality> taken as a loop (and not as one of joints, tendons or flexes)?
bool is_mjcf_loop(const tinyxml2::XMLElement& element);

/// Adds them to the skeleton, whose bodies are read. As in MuJoCo a connect's point on the second body, and a
/// weld without relpose, are where the file's pose has them. Elements with active="false" are passed over.
/// Throws InputError (file, line, element) for an unknown body, sites in place of bodies, and ends on two
/// robots of which one floats: the pose of a free body is no part of the file's zero.
void read_mjcf_loops(const MjcfDocument& document, Skeleton& skeleton);

}  // namespace plumbline::model
