# Every controller's library exports plumbline_controller() and nothing else.
# Usage: cmake -DFOLDER=<libraries> -DNM=<nm> -P check_symbols.cmake
file(GLOB libraries "${FOLDER}/*.so")
if(NOT libraries)
  message(FATAL_ERROR "no controllers in ${FOLDER}")
endif()
foreach(library IN LISTS libraries)
  execute_process(COMMAND ${NM} -D --defined-only ${library} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(STRIP "${symbols}" symbols)
  if(NOT symbols MATCHES "^[0-9a-f]+ T plumbline_controller$")
    message(FATAL_ERROR "${library}: exports\n${symbols}\nexpected plumbline_controller alone")
  endif()
endforeach()
