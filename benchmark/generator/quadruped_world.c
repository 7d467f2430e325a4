/* The quadruped's world: MuJoCo's C interface under the PD law, read at the control's rate. Compiled by
 * quadruped.py.
 *
 *   quadruped_world MODEL.xml NUMBERS TARGETS > LOG
 *
 * NUMBERS: sample (s), steps of a sample, position gain, velocity gain; then twelve numbers each, by motor:
 * gain, delay (steps), time constant of a lag (s, 0: none), level of dry friction; then a patch of friction:
 * motor (-1: none), damping, centre, width; then the ground: stiffness, damping, friction, impedance.
 *
 * TARGETS: a row of twelve positions for each sample.
 *
 * LOG: for each sample 57 doubles: joint positions, joint speeds, the command that holds from there on,
 * MuJoCo's ten sensors (the command that held until then acting), the normal forces of the four feet, place
 * and quaternion of the trunk.
 *
 * The motors are the first twelve; feet are the geoms foot_0 to foot_3; the robot begins in the first
 * keyframe, at rest. */
#include <math.h>
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kMotors = 12, kFeet = 4, kMostLate = 1024, kSensors = 10 };

static const double kSharpness = 0.01; /* rad/s, within which dry friction changes sign */

typedef struct {
  double sample, steps, position_gain, velocity_gain;
  double gain[kMotors], delay[kMotors], lag[kMotors], dry[kMotors];
  double patch[4];
  double ground[4];
} Numbers;

static int fail(const char* what, const char* why) {
  fprintf(stderr, "%s: %s\n", what, why);
  return 2;
}

/* A contact's force is (s depth + b rate - impedance acceleration) / ((1 - impedance) A), s and b the
 * negative numbers of solref and A what MuJoCo takes for the inverse of the foot's mass. This gives the
 * ground the stiffness and damping asked for. */
static void set_ground(mjModel* m, const int* foot, const double* ground) {
  const double impedance = ground[3];
  for (int i = 0; i < kFeet; ++i) {
    const int g = foot[i];
    const double scale = (1.0 - impedance) * m->body_invweight0[2 * m->geom_bodyid[g]];
    m->geom_solref[mjNREF * g] = -scale * ground[0];
    m->geom_solref[mjNREF * g + 1] = -scale * ground[1];
    m->geom_solimp[mjNIMP * g] = impedance;
    m->geom_solimp[mjNIMP * g + 1] = impedance;
    m->geom_friction[3 * g] = ground[2];
    m->geom_priority[g] = 1;
  }
}

static void write_row(const mjModel* m, const mjData* d, const int* foot, const double* command) {
  double normal[kFeet] = {0};
  for (int c = 0; c < d->ncon; ++c) {
    mjtNum force[6];
    mj_contactForce(m, d, c, force);
    for (int i = 0; i < kFeet; ++i) {
      if (d->contact[c].geom1 == foot[i] || d->contact[c].geom2 == foot[i]) {
        normal[i] += force[0];
      }
    }
  }
  fwrite(d->qpos + 7, sizeof(double), kMotors, stdout);
  fwrite(d->qvel + 6, sizeof(double), kMotors, stdout);
  fwrite(command, sizeof(double), kMotors, stdout);
  fwrite(d->sensordata, sizeof(double), kSensors, stdout);
  fwrite(normal, sizeof(double), kFeet, stdout);
  fwrite(d->qpos, sizeof(double), 7, stdout);
}

/* Torque of a motor at a step: the delayed command, times its gain, behind its lag. */
static double torque(const Numbers* n, int i, long step, const double (*history)[kMotors],
                     double* delivered) {
  const long at = step - lround(n->delay[i]);
  const double asked = at < 0 ? 0.0 : n->gain[i] * history[at % kMostLate][i];
  if (n->lag[i] <= 0.0) {
    return asked;
  }
  *delivered += (1.0 - exp(-n->sample / n->steps / n->lag[i])) * (asked - *delivered);
  return *delivered;
}

static double friction(const Numbers* n, int i, double q, double v) {
  double out = -n->dry[i] * tanh(v / kSharpness);
  if (i == (int)n->patch[0]) {
    const double x = (q - n->patch[2]) / n->patch[3];
    out -= n->patch[1] * v * exp(-x * x);
  }
  return out;
}

int main(int argc, char** argv) {
  if (argc != 4) {
    return fail("quadruped_world", "MODEL.xml NUMBERS TARGETS");
  }
  char error[1000] = "";
  mjModel* m = mj_loadXML(argv[1], NULL, error, sizeof error);
  if (m == NULL || m->nu != kMotors || m->nkey < 1 || m->nsensordata != kSensors) {
    return fail(argv[1], m == NULL ? error : "not the quadruped");
  }
  Numbers n;
  FILE* file = fopen(argv[2], "r");
  for (size_t i = 0; file != NULL && i < sizeof n / sizeof(double); ++i) {
    if (fscanf(file, "%lf", (double*)&n + i) != 1) {
      return fail(argv[2], "a number is missing");
    }
  }
  FILE* targets = fopen(argv[3], "r");
  if (file == NULL || targets == NULL) {
    return fail(argv[2], "cannot be opened, or the targets cannot");
  }
  int foot[kFeet];
  for (int i = 0; i < kFeet; ++i) {
    char name[] = "foot_0";
    name[5] = (char)('0' + i);
    foot[i] = mj_name2id(m, mjOBJ_GEOM, name);
  }
  set_ground(m, foot, n.ground);
  m->opt.timestep = n.sample / n.steps;
  mjData* d = mj_makeData(m);
  mj_resetDataKeyframe(m, d, 0);
  static double history[kMostLate][kMotors];
  double delivered[kMotors] = {0}, wanted[kMotors], command[kMotors];
  long step = 0;
  for (;;) {
    for (int i = 0; i < kMotors; ++i) {
      if (fscanf(targets, "%lf", &wanted[i]) != 1) {
        return fflush(stdout) == 0 ? 0 : 1;
      }
    }
    mj_forward(m, d);
    for (int i = 0; i < kMotors; ++i) {
      command[i] = n.position_gain * (wanted[i] - d->qpos[7 + i]) - n.velocity_gain * d->qvel[6 + i];
    }
    write_row(m, d, foot, command);
    for (int s = 0; s < (int)n.steps; ++s, ++step) {
      memcpy(history[step % kMostLate], command, sizeof command);
      for (int i = 0; i < kMotors; ++i) {
        d->ctrl[i] = torque(&n, i, step, (const double(*)[kMotors])history, &delivered[i]);
        d->qfrc_applied[6 + i] = friction(&n, i, d->qpos[7 + i], d->qvel[6 + i]);
      }
      mj_step(m, d);
    }
  }
}
