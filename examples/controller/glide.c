/* A motor glides to a position and stays there:
 *     u = kp (r - q) - kd dq/dt,   r = q0 + (wanted - q0) (1 - cos(pi min(t/time, 1)))/2,
 * q0 the position at the first sample, dq/dt the difference to the sample before over the period. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "controllers/controller.h"

#define LIMIT 0.5 /* N m: the largest torque that this controller ever asks for */
#define PI 3.14159265358979323846

static const plumbline_port inputs[] = {{"position", "rad", PLUMBLINE_COUNT, -INFINITY, INFINITY}};
static const plumbline_port outputs[] = {{"torque", "N m", PLUMBLINE_VALUE, -LIMIT, LIMIT}};
static const plumbline_port constants[] = {{"wanted", "rad", PLUMBLINE_VALUE, -INFINITY, INFINITY},
                                           {"time", "s", PLUMBLINE_VALUE, 1e-3, INFINITY},
                                           {"kp", "N m/rad", PLUMBLINE_VALUE, 0.0, INFINITY},
                                           {"kd", "N m s/rad", PLUMBLINE_VALUE, 0.0, INFINITY}};
static const plumbline_port logged[] = {{"error", "rad", PLUMBLINE_VALUE, -INFINITY, INFINITY}};

typedef struct glide {
  double period, wanted, time, kp, kd, rad_per_count;
  double from, before; /* position at the first sample and at the last one, rad */
  double elapsed;      /* s since the first sample; below 0: there was none */
} glide;

static void reset(void *self) { ((glide *)self)->elapsed = -1.0; }

static void *create(const plumbline_setup *setup, char *message, size_t message_size) {
  glide *self = malloc(sizeof *self);
  if (self == NULL) {
    snprintf(message, message_size, "no memory");
    return NULL;
  }
  const glide made = {setup->period,       setup->constants[0],    setup->constants[1],
                      setup->constants[2], setup->constants[3],    setup->input_scales[0],
                      0.0,                 0.0,                    -1.0};
  *self = made;
  return self;
}

static int step(void *instance, const double *in, double *out, double *log) {
  glide *self = instance;
  const double position = in[0] * self->rad_per_count;
  const int is_first = self->elapsed < 0.0;
  self->from = is_first ? position : self->from;
  self->elapsed = is_first ? 0.0 : self->elapsed + self->period;
  const double rate = is_first ? 0.0 : (position - self->before) / self->period;
  const double share = 0.5 * (1.0 - cos(PI * fmin(self->elapsed / self->time, 1.0)));
  const double error = self->from + (self->wanted - self->from) * share - position;
  self->before = position;
  out[0] = fmin(fmax(self->kp * error - self->kd * rate, -LIMIT), LIMIT);
  if (log != NULL) log[0] = error;
  return 0;
}

static const char *fault(int code) { return code == 0 ? "none" : "unknown"; }
static void get_memory(const void *self, double *memory) { (void)self, (void)memory; }
static void set_memory(void *self, const double *memory) { (void)self, (void)memory; }
static void destroy(void *self) { free(self); }

#define COUNT(list) (uint32_t)(sizeof(list) / sizeof(list)[0])
static const plumbline_controller_api api = {
    PLUMBLINE_CONTROLLER_INTERFACE, "glide", "1", inputs, COUNT(inputs), outputs, COUNT(outputs), constants,
    COUNT(constants), logged, COUNT(logged), NULL, 0, /* no memory that outlasts a stride */
    create, reset, step, fault, get_memory, set_memory, destroy};

const plumbline_controller_api *plumbline_controller(void) { return &api; }
