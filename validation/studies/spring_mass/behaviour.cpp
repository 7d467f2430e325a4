#include "validation/studies/spring_mass/behaviour.h"

#include <fmt/core.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include "simulator/trace/error.h"

namespace plumbline::spring_mass {

Behaviour::Behaviour(Body body, Grid grid) : body_(body), grid_(grid) {
  if (grid.attacks < 2 || grid.splays < 2 || grid.apexes < 2) {
    throw InputError(fmt::format("found a grid of {} x {} x {}, expected at least 2 x 2 x 2", grid.attacks,
                                 grid.splays, grid.apexes));
  }
  if (apex(0) >= body.energy / (body.mass * body.gravity)) {
    throw InputError(
        fmt::format("found an energy of {} J, expected more than the {} J of standing on the "
                    "flattest leg",
                    body.energy, apex(0) * body.mass * body.gravity));
  }
  const auto size = static_cast<std::size_t>(grid.attacks) * static_cast<std::size_t>(grid.splays) *
                    static_cast<std::size_t>(grid.apexes);
  next_apex_.assign(size, std::numeric_limits<double>::quiet_NaN());
  deflection_ = next_apex_;
}

double Behaviour::attack(int i) const { return grid_.lowest_attack + grid_.attack_step * i; }

double Behaviour::splay(int j) const { return grid_.splay_step * j; }

double Behaviour::apex(int k) const {
  const double highest = body_.energy / (body_.mass * body_.gravity);
  return grid_.lowest_apex + (highest - grid_.lowest_apex) * k / (grid_.apexes - 1);
}

void Behaviour::scan_apex(int k) {
  for (int j = 0; j < grid_.splays; ++j) {
    for (int i = 0; i < grid_.attacks; ++i) {
      const Step made = step(body_, apex(k), {attack(i), splay(j)});
      const bool went_on = made.ending == Ending::apex;
      next_apex_[index(i, j, k)] = went_on ? made.apex : std::numeric_limits<double>::quiet_NaN();
      deflection_[index(i, j, k)] = went_on ? made.deflection : std::numeric_limits<double>::quiet_NaN();
    }
  }
}

void Behaviour::scan(int threads) {
  const int count =
      threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::atomic<int> next{0};
  std::vector<std::thread> workers;
  workers.reserve(static_cast<std::size_t>(count));
  for (int t = 0; t < count; ++t) {
    workers.emplace_back([this, &next] {
      for (int k = next++; k < grid_.apexes; k = next++) {
        scan_apex(k);
      }
    });
  }
  for (std::thread& worker : workers) {
    worker.join();
  }
}

std::string Behaviour::heading() const {
  return fmt::format(
      "plumbline: spring-mass behaviour/1, {} attack x {} splay x {} apex doubles of the next apex in m, "
      "then as "
      "many of the deflection in rad; mass {} kg, gravity {} m/s^2, stiffness {} N/m, rest length {} m, "
      "energy {} "
      "J, attack from {} by {} rad, splay by {} rad, apex from {} m\n",
      grid_.attacks, grid_.splays, grid_.apexes, body_.mass, body_.gravity, body_.stiffness,
      body_.rest_length, body_.energy, grid_.lowest_attack, grid_.attack_step, grid_.splay_step,
      grid_.lowest_apex);
}

void Behaviour::keep(const std::string& file) const {
  std::ofstream out(file, std::ios::binary);
  out << heading();
  const auto bytes = static_cast<std::streamsize>(next_apex_.size() * sizeof(double));
  out.write(reinterpret_cast<const char*>(next_apex_.data()), bytes);
  out.write(reinterpret_cast<const char*>(deflection_.data()), bytes);
  out.close();
  if (!out) {
    throw InputError({file, 0, ""}, "a file that cannot be written", "a place to keep the behaviour");
  }
}

bool Behaviour::recall(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!in || !std::getline(in, line) || line + "\n" != heading()) {
    return false;
  }
  std::vector<double> apexes(next_apex_.size()), deflections(next_apex_.size());
  const auto bytes = static_cast<std::streamsize>(apexes.size() * sizeof(double));
  in.read(reinterpret_cast<char*>(apexes.data()), bytes);
  in.read(reinterpret_cast<char*>(deflections.data()), bytes);
  if (!in) {
    return false;
  }
  next_apex_ = std::move(apexes);
  deflection_ = std::move(deflections);
  return true;
}

}  // namespace plumbline::spring_mass
