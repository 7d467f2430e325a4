# Ways to make a target: plumbline_library and plumbline_test. Both carry the project's warnings.

function(plumbline_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
  if(PLUMBLINE_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(PLUMBLINE_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # The sanitizers' own instructions raise this one falsely (GCC 12, in std::regex).
      target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    endif()
    target_link_options(${target} PRIVATE -fsanitize=address,undefined)
  endif()
endfunction()

# For what runs once and leaves the work to the libraries (commands, tests): compiles in less time.
function(plumbline_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Options of tests and of the header that they share. ccache needs -fpch-preprocess to see what GCC reads.
function(plumbline_test_options target)
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  plumbline_options(${target})
  plumbline_compile_quickly(${target})
endfunction()

# What nearly all tests include, compiled once.
function(plumbline_precompiled_tests)
  add_library(precompiled_tests OBJECT ${CMAKE_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(precompiled_tests PRIVATE GTest::gtest_main GTest::gmock Eigen3::Eigen)
  target_precompile_headers(precompiled_tests PRIVATE
    <gmock/gmock.h> <gtest/gtest.h> <Eigen/Dense>
    <algorithm> <cmath> <fstream> <functional> <map> <memory> <random> <sstream> <string> <vector>)
  plumbline_test_options(precompiled_tests)
endfunction()

# Several files in one compilation: a first build takes two thirds of the time, and a change of one file compiles its
# neighbours, too. Names in the unnamed namespaces of a folder must differ.
option(PLUMBLINE_UNITY "Compile libraries several files at a time" OFF)

# What nearly all libraries include, compiled once.
function(plumbline_precompiled_libraries)
  add_library(precompiled_libraries OBJECT ${CMAKE_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(precompiled_libraries PRIVATE Eigen3::Eigen)
  target_precompile_headers(precompiled_libraries PRIVATE
    <Eigen/Dense> <algorithm> <array> <cmath> <filesystem> <functional> <limits> <map> <memory> <optional> <set> <sstream>
    <stdexcept> <string> <utility> <vector>)
  plumbline_library_options(precompiled_libraries)
endfunction()

# Position-independent, because the Python module is made of the same libraries; nobody replaces their functions.
function(plumbline_library_options target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition -fpch-preprocess>)
  plumbline_options(${target})
endfunction()

# plumbline_library(NAME SOURCES a.cpp ... LIBS x y [APART b.cpp ...]): a static library plumbline_NAME, includes from the
# root. APART: sources that are compiled alone, whatever PLUMBLINE_UNITY says, with the reason beside them; EACH_APART: all of them. PRECOMPILED:
# headers of its own in place of what all libraries share.
function(plumbline_library name)
  cmake_parse_arguments(ARG "EACH_APART" "" "SOURCES;LIBS;PRIVATE_LIBS;APART;PRECOMPILED" ${ARGN})
  add_library(plumbline_${name} STATIC ${ARG_SOURCES} ${ARG_APART})
  target_include_directories(plumbline_${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>)
  target_link_libraries(plumbline_${name} PUBLIC ${ARG_LIBS} PRIVATE ${ARG_PRIVATE_LIBS})
  plumbline_library_options(plumbline_${name})
  if(ARG_PRECOMPILED)
    target_precompile_headers(plumbline_${name} PRIVATE ${ARG_PRECOMPILED})
  else()
    target_precompile_headers(plumbline_${name} REUSE_FROM precompiled_libraries)
  endif()
  if(PLUMBLINE_UNITY AND NOT ARG_EACH_APART)
    set_target_properties(plumbline_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    set_source_files_properties(${ARG_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()

# Where controllers' libraries are built, and looked for first.
set(PLUMBLINE_CONTROLLERS ${CMAKE_BINARY_DIR}/controllers)

set(PLUMBLINE_CONTROLLER_INCLUDE ${CMAKE_SOURCE_DIR})
set(PLUMBLINE_CONTROLLER_MAP ${CMAKE_SOURCE_DIR}/controllers/controller.map)
include(PlumblineController)

# plumbline_controller(NAME SOURCES a.cpp ...): a controller, NAME.so in build/controllers.
function(plumbline_controller name)
  cmake_parse_arguments(ARG "" "" "SOURCES" ${ARGN})
  plumbline_controller_target(controller_${name} ${name} ${ARG_SOURCES})
  set_target_properties(controller_${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PLUMBLINE_CONTROLLERS})
  if(NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "/tests/")
    add_dependencies(controllers controller_${name})
  endif()
  plumbline_options(controller_${name})
endfunction()

# plumbline_test(NAME SOURCES a.cpp ... LIBS x y [LABEL slow]): a GoogleTest program, one ctest entry.
function(plumbline_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;LIBS" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_include_directories(test_${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(test_${name} PRIVATE ${ARG_LIBS} GTest::gtest_main GTest::gmock)
  target_compile_definitions(test_${name} PRIVATE PLUMBLINE_ROOT="${CMAKE_SOURCE_DIR}")
  plumbline_test_options(test_${name})
  target_precompile_headers(test_${name} REUSE_FROM precompiled_tests)
  plumbline_link_options(test_${name})
  add_test(NAME ${name} COMMAND test_${name} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  if(ARG_LABEL)
    set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL})
  endif()
endfunction()

# Mesa's software driver leaks 56 bytes for each context, and is unloaded before leaks are looked for, so that
# no suppression can name it.
function(plumbline_test_draws name)
  if(PLUMBLINE_SANITIZE)
    set_tests_properties(${name} PROPERTIES ENVIRONMENT ASAN_OPTIONS=detect_leaks=0)
  endif()
endfunction()

# libSimTKmath exports an old private copy of SUNDIALS; keeping our static copy's names to ourselves makes
# calls land in the right one.
function(plumbline_link_options target)
  target_link_options(${target} PRIVATE -Wl,--exclude-libs,ALL)
endfunction()
