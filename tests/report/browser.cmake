# What the tests in a browser need: sets `chromium`, `node` and `playwright`, or `missing` to why not.
include(${ROOT}/cmake/PlumblineNpm.cmake)

find_program(chromium NAMES chromium)
find_program(node NAMES node nodejs)
set(missing "")
foreach(needed chromium node)
  if(NOT ${needed})
    set(missing "${needed} is not installed (./plumb test installs it)")
  endif()
endforeach()
set(version 1.58.2)  # the later ones want Node.js 20, Debian 12 has 18
if(NOT missing)
  npm_package(playwright-core ${version}
    c99904b5fb60c12f02b1f628ee79b4284f23b2f9ba8bf3d3815b41f032fbdbac0d7fa1f620cb03bb10a9263e7d2836b10ad4a7ad66a7d80783a8cec905aba5b6
    ${NPM})
  set(missing "${NPM_FAILURE}")
endif()
set(playwright ${NPM}/playwright-core-${version}/package)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${OUT} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
