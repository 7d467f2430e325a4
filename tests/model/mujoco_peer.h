// MuJoCo on the same MJCF file: what tests need of it.
#pragma once

#include <mujoco/mujoco.h>
#include <tinyxml2.h>

#include <Eigen/Core>
#include <stdexcept>
#include <string>

#include "tests/model/floating_states.h"

namespace plumbline::test {

struct Mujoco {
  explicit Mujoco(const std::string& path) {
    char error[500] = "";
    m = mj_loadXML(path.c_str(), nullptr, error, sizeof error);
    if (m == nullptr) {
      throw std::runtime_error(error);
    }
    // Contacts, limits, dry friction and equalities are soft constraints there, and others here; a <position>
    // actuator pulls to zero where nothing is commanded.
    m->opt.disableflags |=
        mjDSBL_CONTACT | mjDSBL_LIMIT | mjDSBL_FRICTIONLOSS | mjDSBL_EQUALITY | mjDSBL_ACTUATION;
    m->opt.enableflags |= mjENBL_ENERGY;
    d = mj_makeData(m);
  }
  ~Mujoco() {
    mj_deleteData(d);
    mj_deleteModel(m);
  }
  Mujoco(const Mujoco&) = delete;
  Mujoco& operator=(const Mujoco&) = delete;
  mjModel* m = nullptr;
  mjData* d = nullptr;
};

/// Ours to MuJoCo's, joint by joint: where a chart begins, three angles make a quaternion.
inline void set_state(const Mujoco& mujoco, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  int next = 0;
  for (int j = 0; j < mujoco.m->njnt; ++j) {
    double* qpos = mujoco.d->qpos + mujoco.m->jnt_qposadr[j];
    double* qvel = mujoco.d->qvel + mujoco.m->jnt_dofadr[j];
    const int type = mujoco.m->jnt_type[j];
    for (int i = 0; type == mjJNT_FREE && i < 3; ++i) {
      *qpos++ = q[next];
      *qvel++ = v[next++];
    }
    if (type != mjJNT_FREE && type != mjJNT_BALL) {
      *qpos = q[next];
      *qvel = v[next++];
      continue;
    }
    const Vector3d angles = q.segment<3>(next), rates = v.segment<3>(next);
    const Eigen::Quaterniond turn(rotation_of(angles));
    const Vector3d w = rates_map(angles) * rates;
    const double quaternion[4] = {turn.w(), turn.x(), turn.y(), turn.z()};
    std::copy(quaternion, quaternion + 4, qpos);
    std::copy(w.data(), w.data() + 3, qvel);
    next += 3;
  }
}

/// Our accelerations as MuJoCo gives them.
inline Eigen::VectorXd accelerations(const Mujoco& mujoco, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                     Eigen::VectorXd a) {
  int next = 0;
  for (int j = 0; j < mujoco.m->njnt; ++j) {
    const int type = mujoco.m->jnt_type[j];
    next += type == mjJNT_FREE ? 3 : 0;
    if (type == mjJNT_FREE || type == mjJNT_BALL) {
      a.segment<3>(next) =
          angular_acceleration(q.segment<3>(next), v.segment<3>(next), a.segment<3>(next).eval());
      next += 3;
    } else {
      ++next;
    }
  }
  return a;
}

/// A file without meshes, materials and pictures of the assets: MuJoCo needs them, masses and motion do not
/// where each body states its <inertial>.
inline void take_away_meshes(tinyxml2::XMLElement& element) {
  for (tinyxml2::XMLElement* child = element.FirstChildElement(); child != nullptr;) {
    tinyxml2::XMLElement* const next = child->NextSiblingElement();
    child->DeleteAttribute("material");
    if (std::string(child->Name()) == "asset" || child->Attribute("mesh") != nullptr) {
      element.DeleteChild(child);
    } else {
      take_away_meshes(*child);
    }
    child = next;
  }
}

}  // namespace plumbline::test
