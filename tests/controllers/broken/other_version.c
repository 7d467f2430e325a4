/* A controller that was built for another version of the interface. */
#include "controllers/controller.h"

static const plumbline_controller_api api = {.interface_version = PLUMBLINE_CONTROLLER_INTERFACE + 1, .name = "other"};
const plumbline_controller_api *plumbline_controller(void) { return &api; }
