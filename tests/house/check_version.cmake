# One version: what CMake says (and so `plumbline --version` and the Python module) is the changelog's newest.
#   -DCHANGELOG=FILE -DVERSION=1.2.3
file(STRINGS ${CHANGELOG} headings REGEX "^## ")
list(LENGTH headings count)
if(count EQUAL 0)
  message(FATAL_ERROR "${CHANGELOG}: found no heading, expected `## VERSION, ...`")
endif()
list(GET headings 0 newest)
if(NOT newest MATCHES "^## ([0-9]+\\.[0-9]+\\.[0-9]+)(,|$)")
  message(FATAL_ERROR "${CHANGELOG}: found \"${newest}\", expected `## VERSION, ...`")
endif()
if(NOT CMAKE_MATCH_1 STREQUAL VERSION)
  message(FATAL_ERROR "${CHANGELOG}: found version ${CMAKE_MATCH_1} at the top, expected CMake's ${VERSION}")
endif()
