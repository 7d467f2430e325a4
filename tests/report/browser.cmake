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
set(version 1.65.1)
if(NOT missing)
  npm_package(playwright-core ${version}
    86a3e9cfb6e548c3f1595768784d728814b35ec2a254e77693e9230af994cb00f618f3b60ddf477dc5a7abd34dd061db3590c5819f497c116bf97e7f04ba34ab
    ${NPM})
  set(missing "${NPM_FAILURE}")
endif()
set(playwright ${NPM}/playwright-core-${version}/package)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${OUT} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
