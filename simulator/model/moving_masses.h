// What robot files say of the masses that move, held against what a motion needs.
#pragma once

#include <vector>

#include "simulator/model/model.h"
#include "simulator/model/skeleton_xml.h"

namespace plumbline::model {

/// Mass of each body and of all further out, kg.
std::vector<double> carried_masses(const Skeleton& skeleton);

/// A joint that moves must move mass: that of its own link or of links further out. (Links without mass
/// between two moving joints are how a base moves along several axes.) URDF files end in links without mass,
/// finger tips and tools: their joints have no motion of their own, are held at zero, and are said in
/// Skeleton::left_out. Elsewhere InputError (file, line, link).
void hold_moving_massless(const SkeletonXml& xml, Skeleton& skeleton);

/// Where a link that is SkeletonXml::unusual() moves, it and what is fixed to it must be a body: principal
/// moments not below zero by more than rounding, else InputError (file, line, link). A moment that is larger
/// than the sum of the other two does no harm to the motion. What is taken is said in Skeleton::left_out.
void judge_unusual(const SkeletonXml& xml, Skeleton& skeleton);

}  // namespace plumbline::model
