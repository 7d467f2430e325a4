#include "simulator/model/limbs.h"

#include <algorithm>
#include <cstddef>
#include <set>

namespace plumbline::model {
namespace {

constexpr const char* kWhole = "world";

/// Links that are moved directly by joints behind a motor, pulley, coordinate or joint.
class MovedLinks {
 public:
  explicit MovedLinks(const Model& model) : model_(model) {}

  std::set<int> by(const std::string& name) {
    visit(name);
    return links_;
  }

 private:
  void visit(const std::string& name) {
    if (!seen_.insert(name).second) {
      return;
    }
    for (const Joint& joint : model_.skeleton.joints) {
      if (joint.name == name) {
        links_.insert(joint.child);
      }
    }
    for (const Coordinate& coordinate : model_.coordinates) {
      if (coordinate.name == name) {
        visit_all(coordinate.terms);
      }
    }
    for (const Ratio& ratio : model_.ratios) {
      if (ratio.motor == name) {
        visit_all(ratio.to);
      }
    }
  }

  void visit_all(const std::vector<Term>& terms) {
    for (const Term& term : terms) {
      visit(term.of);
    }
  }

  const Model& model_;
  std::set<std::string> seen_;
  std::set<int> links_;
};

/// Parent of each link; -1: the world.
std::vector<int> parents(const Skeleton& skeleton) {
  std::vector<int> of(skeleton.bodies.size(), -1);
  for (const Joint& joint : skeleton.joints) {
    of[static_cast<std::size_t>(joint.child)] = joint.parent;
  }
  return of;
}

bool is_behind(int link, int first, const std::vector<int>& parent) {
  while (link >= 0 && link != first) {
    link = parent[static_cast<std::size_t>(link)];
  }
  return link == first;
}

bool moves_only_behind(const std::set<int>& links, int first, const std::vector<int>& parent) {
  return !links.empty() &&
         std::all_of(links.begin(), links.end(), [&](int link) { return is_behind(link, first, parent); });
}

}  // namespace

std::vector<std::string> limbs(const Model& model) {
  std::vector<std::string> names;
  if (model.motors.size() < 2) {
    return names;
  }
  names.emplace_back(kWhole);
  const std::vector<int> parent = parents(model.skeleton);
  std::vector<std::size_t> count(parent.size(), 0);  // of motors on each link and behind it
  for (const Motor& motor : model.motors) {
    const std::set<int> links = MovedLinks(model).by(motor.name);
    for (std::size_t b = 0; b < count.size(); ++b) {
      count[b] += moves_only_behind(links, static_cast<int>(b), parent) ? 1 : 0;
    }
  }
  for (std::size_t b = 0; b < count.size(); ++b) {
    bool is_at_fork = false;
    for (std::size_t other = 0; other < count.size(); ++other) {
      is_at_fork = is_at_fork || (other != b && parent[other] == parent[b] && count[other] > 0);
    }
    if (count[b] >= 2 && is_at_fork) {
      names.push_back(model.skeleton.bodies[b].name);
    }
  }
  return names;
}

bool is_on_limb(const Model& model, const std::string& limb, const Motor& motor) {
  const int first = model.body_index(limb);
  return limb == kWhole ||
         (first >= 0 && moves_only_behind(MovedLinks(model).by(motor.name), first, parents(model.skeleton)));
}

}  // namespace plumbline::model
