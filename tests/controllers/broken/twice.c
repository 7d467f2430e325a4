/* A controller with two inputs of one name. */
#include <math.h>
#include <stdlib.h>

#include "controllers/controller.h"

static const plumbline_port inputs[] = {{"q", "rad", PLUMBLINE_COUNT, -INFINITY, INFINITY},
                                        {"q", "rad", PLUMBLINE_COUNT, -INFINITY, INFINITY}};
static void *create(const plumbline_setup *setup, char *message, size_t size) {
  (void)setup, (void)message, (void)size;
  return NULL;
}
static void reset(void *self) { (void)self; }
static int step(void *self, const double *in, double *out, double *log) {
  (void)self, (void)in, (void)out, (void)log;
  return 0;
}
static const char *fault(int code) { return code == 0 ? "none" : "unknown"; }
static void get_memory(const void *self, double *memory) { (void)self, (void)memory; }
static void set_memory(void *self, const double *memory) { (void)self, (void)memory; }

static const plumbline_controller_api api = {.interface_version = PLUMBLINE_CONTROLLER_INTERFACE,
                                             .name = "twice",
                                             .version = "1",
                                             .inputs = inputs,
                                             .input_count = 2,
                                             .create = create,
                                             .reset = reset,
                                             .step = step,
                                             .fault = fault,
                                             .get_memory = get_memory,
                                             .set_memory = set_memory,
                                             .destroy = reset};
const plumbline_controller_api *plumbline_controller(void) { return &api; }
