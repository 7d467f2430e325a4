# npm_package: what it unpacks, and what it says when it cannot. The client is a script here.
# Usage: cmake -DROOT=<project> -DOUT=<folder> -P npm_test.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${OUT})
set(PLUMBLINE_NPM_FOLDER ${OUT}/by_hand)
set(PLUMBLINE_NPM_CLIENT ${OUT}/npm)
include(${ROOT}/cmake/PlumblineNpm.cmake)

function(expect condition)
  if(NOT (${ARGN}))
    message(SEND_ERROR "${condition}: \"${NPM_FAILURE}\"")
  endif()
endfunction()

set(tarball ${OUT}/shelf/tool-1.2.3.tgz)
file(WRITE ${OUT}/package/package.json "{}")
file(MAKE_DIRECTORY ${OUT}/shelf)
execute_process(COMMAND ${CMAKE_COMMAND} -E tar czf ${tarball} package WORKING_DIRECTORY ${OUT}
  COMMAND_ERROR_IS_FATAL ANY)
file(SHA512 ${tarball} good)
string(REPEAT 0 128 bad)
# npm pack NAME@VERSION --ignore-scripts --silent --pack-destination DIR
file(WRITE ${OUT}/npm "#!/bin/sh
test \"$1 $3 $4 $5\" = 'pack --ignore-scripts --silent --pack-destination' || exit 9
test \"$2\" = tool@1.2.3 || { echo \"404 no such package\" >&2; echo \"second line\" >&2; exit 1; }
cp '${tarball}' \"$6\"/tool-1.2.3.tgz
")
file(CHMOD ${OUT}/npm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)

npm_package(tool 1.2.3 ${bad} ${OUT}/a)
expect("another hash is refused" NPM_FAILURE MATCHES "tool@1.2.3: its SHA-512 is not the expected one")
expect("and nothing is left of it" NOT EXISTS ${OUT}/a/tool-1.2.3.tgz AND NOT EXISTS ${OUT}/a/tool-1.2.3)

npm_package(tool 9.9.9 ${good} ${OUT}/b)
expect("what is not there is named" NPM_FAILURE MATCHES "^tool@9.9.9: npm pack ended with 1 404 .*put tool-9.9.9.tgz into a folder")
expect("in one line" NOT NPM_FAILURE MATCHES "\n")

npm_package(tool 1.2.3 ${good} ${OUT}/c)
expect("the right one comes" NOT NPM_FAILURE AND EXISTS ${OUT}/c/tool-1.2.3/package/package.json)

file(MAKE_DIRECTORY ${OUT}/by_hand)
file(RENAME ${tarball} ${OUT}/by_hand/tool-1.2.3.tgz)
npm_package(tool 1.2.3 ${good} ${OUT}/d)
expect("from a folder too" NOT NPM_FAILURE AND EXISTS ${OUT}/d/tool-1.2.3/package/package.json)

# No registry has its address in the project.
file(GLOB files ${ROOT}/cmake/* ${ROOT}/CMakeLists.txt ${ROOT}/packages.txt ${ROOT}/plumb ${ROOT}/scripts/* ${ROOT}/validation/report/*
  ${ROOT}/tests/report/*)
foreach(file IN LISTS files)
  if(NOT file MATCHES "npm_test.cmake$")
    file(STRINGS ${file} lines REGEX "https?://[a-z.]*(npm|registry|pypi|crates)")
    if(lines)
      message(SEND_ERROR "${file}: the address of a registry: ${lines}")
    endif()
  endif()
endforeach()
