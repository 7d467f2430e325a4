/* The foreign world: MuJoCo's C interface under a PD law, logged at the control's rate. Compiled by ../go2_hidden.py.
 *
 *   world MODEL.xml REFERENCE LOG SAMPLE STEPS KP KD FIRST LATE
 *
 * REFERENCE has a row of joint positions for each sample; LOG gets, for each sample, the joints' positions, the commands
 * that hold from there on, and MuJoCo's sensors (the command that held until then acting). A sample lasts SAMPLE seconds
 * in STEPS steps. Commands of the three motors from FIRST on (-1: of none) take effect LATE samples later. The robot is
 * let down from its keyframe before the log begins. */
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>

enum { kMotors = 12, kMostLate = 16 };

static const double kSettle = 1.0; /* s, under the first row */

int main(int argc, char** argv) {
  if (argc != 10) {
    fprintf(stderr, "world MODEL.xml REFERENCE LOG SAMPLE STEPS KP KD FIRST LATE\n");
    return 2;
  }
  char error[1000] = "";
  mjModel* m = mj_loadXML(argv[1], NULL, error, sizeof error);
  if (m == NULL || m->nu != kMotors || m->nq != 7 + kMotors || m->nkey < 1) {
    fprintf(stderr, "%s: %s\n", argv[1], m == NULL ? error : "not a quadruped of 12 motors with a keyframe");
    return 2;
  }
  const double sample = atof(argv[4]), kp = atof(argv[6]), kd = atof(argv[7]);
  const int steps = atoi(argv[5]), first = atoi(argv[8]), late = atoi(argv[9]);
  FILE* reference = fopen(argv[2], "r");
  FILE* log = fopen(argv[3], "w");
  if (reference == NULL || log == NULL || steps < 1 || late < 0 || late >= kMostLate) {
    fprintf(stderr, "%s: a file that cannot be opened, or a number out of range\n", argv[2]);
    return 2;
  }
  m->opt.timestep = sample / steps;
  mjData* d = mj_makeData(m);
  mj_resetDataKeyframe(m, d, 0);
  double wanted[kMotors], command[kMostLate][kMotors] = {{0}};
  int settling = (int)(kSettle / sample);
  int more = 1;
  for (int i = 0; more && i < kMotors; ++i) {
    more = fscanf(reference, "%lf", &wanted[i]) == 1;
  }
  for (long k = 0; more; ++k) {
    mj_forward(m, d);
    double* now = command[k % kMostLate];
    for (int i = 0; i < kMotors; ++i) {
      const double limit = m->actuator_ctrlrange[2 * i + 1];
      const double torque = kp * (wanted[i] - d->qpos[7 + i]) - kd * d->qvel[6 + i];
      now[i] = torque > limit ? limit : torque < -limit ? -limit : torque;
    }
    if (k >= settling) {
      for (int i = 0; i < kMotors; ++i) {
        fprintf(log, "%.9g ", d->qpos[7 + i]);
      }
      for (int i = 0; i < kMotors; ++i) {
        fprintf(log, "%.9g ", now[i]);
      }
      for (int i = 0; i < m->nsensordata; ++i) {
        fprintf(log, "%.9g ", d->sensordata[i]);
      }
      fprintf(log, "\n");
      for (int i = 0; more && i < kMotors; ++i) {
        more = fscanf(reference, "%lf", &wanted[i]) == 1;
      }
    }
    for (int i = 0; i < kMotors; ++i) {
      const int is_late = first >= 0 && i >= first && i < first + 3 && k >= late;
      d->ctrl[i] = is_late ? command[(k - late) % kMostLate][i] : now[i];
    }
    for (int s = 0; s < steps; ++s) {
      mj_step(m, d);
    }
  }
  return fclose(log) == 0 ? 0 : 1;
}
