/* The C interface of a controller.
 *
 * A controller is one shared library that exports one function, plumbline_controller(). The simulator and the
 * driver on the robot load the same file, so that what was certified is what runs: the file's SHA-256 is the
 * controller's identity. It can be written in C, C++ or any language that makes C functions.
 *
 * Life of a controller:
 *
 *     const plumbline_controller_api *api = plumbline_controller();
 *     void *self = api->create(&setup, message, sizeof message);   allocates; NULL and a message where it refuses
 *     api->reset(self);                                            before the first step and after every stop
 *     api->step(self, inputs, outputs, log);                       once every period
 *     api->destroy(self);
 *
 * step() is real-time code: it neither allocates, blocks, throws nor calls the operating system, and its time is
 * bounded. Equal inputs after reset() give equal outputs, to the last bit: no clock, no random numbers, no state
 * outside `self`. */
/* clang-format off */
#ifndef PLUMBLINE_CONTROLLER_H
#define PLUMBLINE_CONTROLLER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes whenever a structure below changes its layout or meaning. A host refuses another number. */
#define PLUMBLINE_CONTROLLER_INTERFACE 1

/* What a port carries. All ports are doubles: whole numbers are exact up to 2^53. */
typedef enum plumbline_port_kind {
  PLUMBLINE_COUNT = 0,  /* counts of an encoder: a whole number; setup says what one count is */
  PLUMBLINE_SWITCH = 1, /* 0 open, 1 closed */
  PLUMBLINE_VALUE = 2   /* a number in the port's unit */
} plumbline_port_kind;

/* One input, output, constant, logged value or memory of the controller. */
typedef struct plumbline_port {
  const char *name;         /* letters, digits and underscores; unique in its list */
  const char *unit;         /* SI, as udunits2 reads it: "rad", "N m", "1". Of a count: the unit of count times scale */
  plumbline_port_kind kind; /* outputs, constants, log and memory: PLUMBLINE_VALUE */
  double lower;             /* least value that the controller takes or gives; -INFINITY: none */
  double upper;             /* largest one; INFINITY: none */
} plumbline_port;

/* What the host gives to create(). The arrays live at least until create() returns. */
typedef struct plumbline_setup {
  double period;              /* s between two steps */
  const double *constants;    /* one for each constant, in its unit */
  const double *input_scales; /* one for each input: unit per count of a count; 1 for other kinds */
} plumbline_setup;

typedef struct plumbline_controller_api {
  uint32_t interface_version; /* PLUMBLINE_CONTROLLER_INTERFACE */
  const char *name;           /* what it is called: "mabel_hopping" */
  const char *version;        /* of the controller, for people and for wiring files: "1" */

  const plumbline_port *inputs;
  uint32_t input_count;
  const plumbline_port *outputs; /* their limits are the largest commands that the controller ever gives */
  uint32_t output_count;
  const plumbline_port *constants;
  uint32_t constant_count;
  const plumbline_port *log; /* what step() reports beside its outputs: phase, references, errors */
  uint32_t log_count;
  /* Numbers that outlast a stride, such as an angle that is updated at each landing. A host may read and set them
   * between two steps, to find the return map of a gait. */
  const plumbline_port *memory;
  uint32_t memory_count;

  /* Allocates all that the controller will ever need. NULL where it refuses: `message` then holds one line
   * that says which constant, what was found and what is expected. */
  void *(*create)(const plumbline_setup *setup, char *message, size_t message_size);
  /* As just created. */
  void (*reset)(void *self);
  /* One sample. 0: all is well. Any other number: the controller gives up, outputs are all 0 from then on until
   * reset(), and fault() says why. `log` may be NULL. */
  int (*step)(void *self, const double *inputs, double *outputs, double *log);
  /* In words, what a number that step() returned means. Never NULL; lives as long as the library. */
  const char *(*fault)(int code);
  void (*get_memory)(const void *self, double *memory);
  void (*set_memory)(void *self, const double *memory);
  void (*destroy)(void *self); /* NULL is allowed */
} plumbline_controller_api;

/* The one function that the library exports, also where it is compiled with hidden symbols. Never NULL. */
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
const plumbline_controller_api *plumbline_controller(void);

/* Its name, for dlsym. */
#define PLUMBLINE_CONTROLLER_SYMBOL "plumbline_controller"

#ifdef __cplusplus
}
#endif

#endif /* PLUMBLINE_CONTROLLER_H */
