# How a controller is built, here and behind find_package(Plumbline). PLUMBLINE_CONTROLLER_INCLUDE: the folder from which
# controllers/controller.h is included; PLUMBLINE_CONTROLLER_MAP: the list of what a controller exports.

# plumbline_controller_target(TARGET NAME SOURCES...): a module NAME.so. It exports plumbline_controller() and nothing else,
# so that several can be loaded into one program.
function(plumbline_controller_target target name)
  add_library(${target} MODULE ${ARGN})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} PREFIX "" SUFFIX .so
    C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON LINK_DEPENDS ${PLUMBLINE_CONTROLLER_MAP})
  target_include_directories(${target} PRIVATE ${PLUMBLINE_CONTROLLER_INCLUDE})
  # The same file wherever the project lies: its hash is the controller's identity.
  target_compile_options(${target} PRIVATE -ffile-prefix-map=${CMAKE_SOURCE_DIR}/=
    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-gnu-unique>)
  target_link_options(${target} PRIVATE -Wl,--version-script=${PLUMBLINE_CONTROLLER_MAP})
  if(NOT PLUMBLINE_SANITIZE)
    target_link_options(${target} PRIVATE -Wl,--no-undefined)
  endif()
  target_link_libraries(${target} PRIVATE m)
endfunction()
