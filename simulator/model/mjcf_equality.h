// What <equality> of an MJCF file closes or ties: loops by <connect> and <weld>, joints by <joint>.
#pragma once

#include <tinyxml2.h>

#include <string>

#include "simulator/model/mjcf_document.h"
#include "simulator/model/model.h"

namespace plumbline::model {

/// Is this element of <equality> taken (and not one of tendons or flexes)?
bool is_mjcf_equality(const tinyxml2::XMLElement& element);

/// Adds loops to the skeleton, whose bodies are read, and ties its joints. As in MuJoCo a connect's point on
/// the second body, and a weld without relpose, are where the file's pose has them; <joint> says
///   q1 - ref1 = a0 + a1 (q2 - ref2),   polycoef = a0 a1 0 0 0,
/// without joint2 q1 = ref1 + a0. Elements with active="false" are passed over; their softness is not taken.
/// Throws InputError (file, line, element) for an unknown body or joint, sites in place of bodies, ends on
/// two robots of which one floats (the pose of a free body is no part of the file's zero), and polynomials of
/// a higher order.
void read_mjcf_equalities(const MjcfDocument& document, Skeleton& skeleton);

}  // namespace plumbline::model
