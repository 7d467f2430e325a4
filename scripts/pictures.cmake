# The report's pictures, by headless Chromium. Usage: cmake -DROOT= -DNPM= -DPAGE= -DOUT= -P pictures.cmake
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/report/browser.cmake)
if(missing)
  message(FATAL_ERROR "${missing}")
endif()
run(${node} ${ROOT}/scripts/pictures.mjs ${playwright} ${chromium} ${PAGE} ${OUT})
