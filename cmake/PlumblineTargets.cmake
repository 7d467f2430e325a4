# Two ways to make a target: plumbline_library and plumbline_test. Both carry the project's warnings.

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

# plumbline_library(NAME SOURCES a.cpp ... LIBS x y): a static library plumbline_NAME, includes from the root.
function(plumbline_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS;PRIVATE_LIBS" ${ARGN})
  add_library(plumbline_${name} STATIC ${ARG_SOURCES})
  target_include_directories(plumbline_${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(plumbline_${name} PUBLIC ${ARG_LIBS} PRIVATE ${ARG_PRIVATE_LIBS})
  plumbline_options(plumbline_${name})
endfunction()

# plumbline_test(NAME SOURCES a.cpp ... LIBS x y [LABEL slow]): a GoogleTest program, one ctest entry.
function(plumbline_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;LIBS" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_include_directories(test_${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(test_${name} PRIVATE ${ARG_LIBS} GTest::gtest_main GTest::gmock)
  target_compile_definitions(test_${name} PRIVATE PLUMBLINE_ROOT="${CMAKE_SOURCE_DIR}")
  plumbline_options(test_${name})
  plumbline_link_options(test_${name})
  add_test(NAME ${name} COMMAND test_${name} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  if(ARG_LABEL)
    set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL})
  endif()
endfunction()

# libSimTKmath exports an old private copy of SUNDIALS; keeping our static copy's names to ourselves makes
# calls land in the right one.
function(plumbline_link_options target)
  target_link_options(${target} PRIVATE -Wl,--exclude-libs,ALL)
endfunction()
