// Which code computes the rigid bodies' mass matrix and bias.
#pragma once

namespace plumbline::model {

enum class Engine {
  tree,     ///< TreeDynamics: composite rigid bodies, in one pass over the tree (the default)
  simbody,  ///< Simbody's own operators: slower, for whoever wants Simbody's numbers
};

/// Of all plants and mechanisms of this program, from now on. Feet, effects, drives and the integrator are
/// the same with both. To be called before threads are started.
void set_engine(Engine engine);

}  // namespace plumbline::model
