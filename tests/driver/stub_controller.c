/* A controller for tests: a damped spring, and on request each way in which a controller can fail. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "controllers/controller.h"

enum { none, nan_command, beyond_limit, too_quick, gives_up, hangs, crashes, ends };

typedef struct stub {
  double constants[2], scale, last;
  long steps;
} stub;

static void *create(const plumbline_setup *setup, char *message, size_t size) {
  stub *self = calloc(1, sizeof *self);
  (void)message;
  (void)size;
  memcpy(self->constants, setup->constants, sizeof self->constants);
  self->scale = setup->input_scales[0];
  return self;
}

static void reset(void *data) {
  stub *self = data;
  self->steps = 0;
  self->last = 0.0;
}

static int step(void *data, const double *inputs, double *outputs, double *log) {
  stub *self = data;
  const double at = inputs[0] * self->scale;
  outputs[0] = -2.0 * at - 20.0 * (self->steps > 0 ? at - self->last : 0.0);
  self->last = at;
  ++self->steps;
  if (log != NULL) log[0] = (double)self->steps;
  if (self->steps <= (long)self->constants[1]) return 0;
  switch ((int)self->constants[0]) {
    case nan_command:
      outputs[0] = NAN;
      break;
    case beyond_limit:
      outputs[0] = 1e3;
      break;
    case too_quick:
      outputs[0] = self->steps % 2 != 0 ? 9.0 : -9.0;
      break;
    case gives_up:
      return 7;
    case hangs:
      for (;;) {
      }
    case crashes:
      *(volatile int *)8 = 1;
      break;
    case ends:
      _Exit(0);
    default:
      break;
  }
  return 0;
}

static const char *fault(int code) { return code == 7 ? "seven" : "unknown"; }
static void no_memory(const void *self, double *memory) {
  (void)self;
  (void)memory;
}
static void set_no_memory(void *self, const double *memory) {
  (void)self;
  (void)memory;
}

static const plumbline_port inputs_[] = {{"joint", "rad", PLUMBLINE_COUNT, -INFINITY, INFINITY},
                                         {"tilt", "rad", PLUMBLINE_VALUE, -INFINITY, INFINITY},
                                         {"foot", "1", PLUMBLINE_SWITCH, 0, 1}};
static const plumbline_port outputs_[] = {{"motor", "N m", PLUMBLINE_VALUE, -10, 10}};
static const plumbline_port constants_[] = {{"fault", "1", PLUMBLINE_VALUE, 0, ends},
                                            {"at", "1", PLUMBLINE_VALUE, 0, 1e9}};
static const plumbline_port log_[] = {{"step", "1", PLUMBLINE_VALUE, 0, INFINITY}};

const plumbline_controller_api *plumbline_controller(void) {
  static const plumbline_controller_api api = {PLUMBLINE_CONTROLLER_INTERFACE,
                                               "stub",
                                               "1",
                                               inputs_,
                                               3,
                                               outputs_,
                                               1,
                                               constants_,
                                               2,
                                               log_,
                                               1,
                                               NULL,
                                               0,
                                               create,
                                               reset,
                                               step,
                                               fault,
                                               no_memory,
                                               set_no_memory,
                                               free};
  return &api;
}
