// Only headers: PlumblineTargets.cmake lists them.
