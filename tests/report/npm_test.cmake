# npm_package: what it unpacks, and what it says when it cannot. The registry is a folder here.
# Usage: cmake -DROOT=<project> -DOUT=<folder> -P npm_test.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${OUT})
set(PLUMBLINE_NPM_REGISTRY file://${OUT}/registry)
set(PLUMBLINE_NPM_FOLDER ${OUT}/by_hand)
include(${ROOT}/cmake/PlumblineNpm.cmake)

function(expect condition)
  if(NOT (${ARGN}))
    message(SEND_ERROR "${condition}: \"${NPM_FAILURE}\"")
  endif()
endfunction()

set(tarball ${OUT}/registry/tool/-/tool-1.2.3.tgz)
file(WRITE ${OUT}/package/package.json "{}")
file(MAKE_DIRECTORY ${OUT}/registry/tool/-)
execute_process(COMMAND ${CMAKE_COMMAND} -E tar czf ${tarball} package WORKING_DIRECTORY ${OUT}
  COMMAND_ERROR_IS_FATAL ANY)
file(SHA512 ${tarball} good)
string(REPEAT 0 128 bad)

npm_package(tool 1.2.3 ${bad} ${OUT}/a)
expect("another hash is refused" NPM_FAILURE MATCHES "tool-1.2.3.tgz: its SHA-512 is not the expected one")
expect("and nothing is left of it" NOT EXISTS ${OUT}/a/tool-1.2.3.tgz AND NOT EXISTS ${OUT}/a/tool-1.2.3)

npm_package(tool 9.9.9 ${good} ${OUT}/b)
expect("what is not there is named" NPM_FAILURE MATCHES "^file://.*/tool-9.9.9.tgz: .* put tool-9.9.9.tgz into a folder")
expect("in one line" NOT NPM_FAILURE MATCHES "\n")

npm_package(tool 1.2.3 ${good} ${OUT}/c)
expect("the right one comes" NOT NPM_FAILURE AND EXISTS ${OUT}/c/tool-1.2.3/package/package.json)

file(MAKE_DIRECTORY ${OUT}/by_hand)
file(RENAME ${tarball} ${OUT}/by_hand/tool-1.2.3.tgz)
npm_package(tool 1.2.3 ${good} ${OUT}/d)
expect("from a folder too" NOT NPM_FAILURE AND EXISTS ${OUT}/d/tool-1.2.3/package/package.json)
