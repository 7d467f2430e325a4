#include "contact/contact_law.h"

namespace plumbline::contact {

void NormalLaw::switches(double /*depth*/, double /*rate*/, const double* /*p*/,
                         std::vector<double>& /*g*/) const {}

void TangentialLaw::state_rate(const Eigen::Vector2d& /*slip*/, double /*normal*/, const double* /*state*/,
                               const double* /*p*/, double* /*rate*/) const {}

double TangentialLaw::stored_energy(double /*normal*/, const double* /*state*/, const double* /*p*/) const {
  return 0.0;
}

bool TangentialLaw::is_isotropic(const double* /*p*/) const { return true; }

void NormalLaw::apply(const GroundChange& /*change*/, double* /*p*/) const {}

void TangentialLaw::apply(const GroundChange& /*change*/, double* /*p*/) const {}

}  // namespace plumbline::contact
