# A robot's names live in robots/ and in controllers/<robot>_*: no C++ of the simulator and of validation may know a robot, a leg
# or a sensor by name. Comments may, and the examples that commands print under their help.
# Usage: cmake -DROOT=<project> -P check_names.cmake
cmake_minimum_required(VERSION 3.25)

set(names "mabel|emps|thumper|atrias|hopper|mLA|mLS|leg_angle|leg_shape|boom_pitch|bsp_|knee_|thigh_|torso_wanted|K_T")
set(quoted "\"(tower|torso|left|right|toe|hip|hip_x|hip_z)\"|_(left|right)\"")

if(NOT IS_DIRECTORY "${ROOT}")
  message(FATAL_ERROR "ROOT: found '${ROOT}', expected the project's folder")
endif()
set(violations 0)
file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/simulator/*.h" "${ROOT}/simulator/*.cpp" "${ROOT}/validation/*.h"
     "${ROOT}/validation/*.cpp")
foreach(file IN LISTS files)
  file(READ "${ROOT}/${file}" text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "footer\\([^;]*;" "" text "${text}")  # the examples of a command
  # Where an effect comes from is named by its paper's title.
  if(file MATCHES "^simulator/effects/")
    continue()
  endif()
  string(REGEX MATCHALL "(^|[^A-Za-z0-9])(${names})|${quoted}" found "${text}")
  if(found)
    list(REMOVE_DUPLICATES found)
    string(REGEX REPLACE "[\n ]" "" found "${found}")
    message(NOTICE "${file}: names ${found}")
    math(EXPR violations "${violations} + 1")
  endif()
endforeach()
list(LENGTH files count)
if(count EQUAL 0)
  message(FATAL_ERROR "no source files below ${ROOT}")
elseif(violations GREATER 0)
  message(FATAL_ERROR "${violations} of ${count} files name a robot, a leg or a sensor; their place is robots/ or controllers/<robot>_*")
endif()
message(STATUS "${count} files, no robot's names")
