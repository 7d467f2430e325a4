// A certificate's body for small_plan.h, as certify would write it.
#pragma once

#include <string>

#include "controllers/driver/json.h"

namespace plumbline::driver {

inline Json small_body() {
  return parse_json(R"({
    "format": "plumbline-certificate/1", "title": "test", "model": "model.yaml", "valid_until": "2099-12-31",
    "files": [],
    "controller": {"file": "stub.so", "sha256": "", "name": "stub", "version": "1",
                   "constants": [{"name": "fault", "value": 0}, {"name": "at", "value": 0}],
                   "log": [{"name": "step"}]},
    "drive": {
      "robot": "one joint", "period": 0.001,
      "channels": [{"name": "joint", "unit": "rad", "kind": "count", "scale": 0.001, "speed": 20, "rest": 0.05},
                   {"name": "tilt", "unit": "rad", "kind": "value", "scale": 1, "speed": 50, "rest": null},
                   {"name": "foot", "unit": "1", "kind": "switch", "scale": 1, "speed": null, "rest": null}],
      "commands": [{"name": "motor", "unit": "N m", "limit": 10, "slew": 3000,
                    "hold": {"channel": "joint", "stiffness": 5, "damping": 0.1}}],
      "inputs": [{"port": "joint", "from": ["joint"], "scale": 0.001, "fixed": null},
                 {"port": "tilt", "from": ["tilt"], "scale": 1, "fixed": null},
                 {"port": "foot", "from": ["foot"], "scale": 1, "fixed": null}],
      "outputs": [{"port": "motor", "to": "motor"}],
      "workspace": [{"name": "joint", "of": {"joint": 1}, "from": -1, "to": 1, "deceleration": 50}],
      "handover": [{"name": "joint", "of": {"joint": 1}, "from": -0.5, "to": 0.5}],
      "packets": {"lost_in_succession": 2, "lost": 5, "duplicated": 1, "reordered": 1, "corrupt": 1},
      "times": {"silence": 0.05, "answer": 0.04, "late": 0, "controller": 0.03}
    }
  })");
}

}  // namespace plumbline::driver
