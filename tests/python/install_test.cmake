# Installs the Python package into an empty folder and imports it from there. Needs BUILD and PYTHON.
set(folder ${BUILD}/tests/python/installed)
file(REMOVE_RECURSE ${folder})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component python --prefix ${folder}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${folder}/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1
          ${PYTHON} -c "import plumbline, sys; print(plumbline.__file__, len(plumbline.effects()))"
  OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
if(NOT found MATCHES "^${folder}/.* [1-9][0-9]+\n$")
  message(FATAL_ERROR "found ${found}, expected the package in ${folder} and its effects")
endif()
