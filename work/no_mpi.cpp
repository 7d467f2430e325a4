// In place of mpi_ranks.cpp where there is no MPI.
#include "work/workers.h"

namespace plumbline::work {

std::string mpi_name() { return ""; }

std::unique_ptr<Workers> start(const std::string& /*times*/) {
  if (started_together() > 1) {
    throw Refused("found " + std::to_string(started_together()) +
                  " copies started together, expected one: this program was built without MPI");
  }
  return std::make_unique<Threads>(1);
}

}  // namespace plumbline::work
