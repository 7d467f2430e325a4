// What a change of structure makes of a rigid body.
#pragma once

#include <string>

#include "simulator/effects/law.h"
#include "simulator/model/model.h"

namespace plumbline::model {

/// The body with a change in it, in this order:
///   m' = m + change.mass, I' = I m' / m   (the link's own material is denser)      [kg, kg m^2]
///   c' = c + change.com_shift                                                     [m]
///   S = tr(I')/2 1 - I', S' = F S F^T with F = change.stretch, I' = tr(S') 1 - S'  (second moments of its
///   matter) then a point mass change.payload at change.payload_at, by the theorem of parallel axes for two
///   bodies: I'' = I' + m' p / (m' + p) (|r - c'|^2 1 - (r - c')(r - c')^T) about the common centre of mass.
/// `who` begins the message of the InputError that is thrown when no mass remains.
/// Source: Atkeson, An and Hollerbach, Int. J. of Robotics Research 5(3) (1986).
void change_body(Body& body, const effects::StructureChange& change, const std::string& who);

}  // namespace plumbline::model
