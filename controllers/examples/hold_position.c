/* The smallest useful controller: one motor is held at a position by a spring and a damper in software,
 *     u = kp (position_wanted - q) - kd dq/dt,   dq/dt = (q - q one sample ago) / period,
 * with u held within the motor's limit. Copy this file to begin a controller of your own.
 *
 * Build: plumbline_controller(NAME SOURCES ...) in controllers/CMakeLists.txt, or by hand
 *     cc -shared -fPIC -fvisibility=hidden -O2 -I PROJECT -o hold_position.so hold_position.c -lm */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "controllers/controller.h"

#define LIMIT 30.0 /* N m: the largest torque that this controller ever asks for */

/* Ports: what comes in, what goes out. A wiring file says which sensor and which motor each one is. */
static const plumbline_port inputs[] = {{"position", "rad", PLUMBLINE_COUNT, -INFINITY, INFINITY}};
static const plumbline_port outputs[] = {{"torque", "N m", PLUMBLINE_VALUE, -LIMIT, LIMIT}};
static const plumbline_port constants[] = {
    {"position_wanted", "rad", PLUMBLINE_VALUE, -INFINITY, INFINITY},
    {"kp", "N m/rad", PLUMBLINE_VALUE, 0.0, INFINITY},
    {"kd", "N m s/rad", PLUMBLINE_VALUE, 0.0, INFINITY}};
static const plumbline_port logged[] = {{"error", "rad", PLUMBLINE_VALUE, -INFINITY, INFINITY}};

/* One controller at work. Whatever it must remember from sample to sample stands here, never in a global. */
typedef struct controller {
  double period, wanted, kp, kd, rad_per_count;
  double before; /* position at the last sample, rad */
  int started;
} controller;

/* The only place that may allocate. Refuse what cannot work, in one line. */
static void *create(const plumbline_setup *setup, char *message, size_t message_size) {
  controller *self = malloc(sizeof *self);
  if (self == NULL) {
    snprintf(message, message_size, "no memory");
    return NULL;
  }
  const controller made = {setup->period,       setup->constants[0],    setup->constants[1],
                           setup->constants[2], setup->input_scales[0], 0.0, 0};
  *self = made;
  return self;
}

static void reset(void *self) { ((controller *)self)->started = 0; }

/* Once every period: no allocation, no system call, bounded time. */
static int step(void *instance, const double *in, double *out, double *log) {
  controller *self = instance;
  const double position = in[0] * self->rad_per_count;
  const double rate = self->started ? (position - self->before) / self->period : 0.0;
  const double error = self->wanted - position;
  self->before = position;
  self->started = 1;
  out[0] = fmin(fmax(self->kp * error - self->kd * rate, -LIMIT), LIMIT);
  if (log != NULL) log[0] = error;
  return 0; /* another number would mean: I give up, and fault() says why */
}

static const char *fault(int code) { return code == 0 ? "none" : "unknown"; }
static void get_memory(const void *self, double *memory) { (void)self, (void)memory; }
static void set_memory(void *self, const double *memory) { (void)self, (void)memory; }
static void destroy(void *self) { free(self); }

#define COUNT(list) (uint32_t)(sizeof(list) / sizeof(list)[0])
static const plumbline_controller_api api = {
    PLUMBLINE_CONTROLLER_INTERFACE, "hold_position", "1", inputs, COUNT(inputs), outputs, COUNT(outputs),
    constants, COUNT(constants), logged, COUNT(logged), NULL, 0, /* no memory that outlasts a stride */
    create, reset, step, fault, get_memory, set_memory, destroy};

const plumbline_controller_api *plumbline_controller(void) { return &api; }
