# Makes a report of a twin's trials and looks at it in headless Chromium (browser_test.mjs), driven by playwright-core
# from the npm registry. Prints "skipped: why" where something that it needs is not installed.
# Usage: cmake -DPROGRAM=<plumbline> -DROOT=<project> -DNPM=<folder for packages> -DOUT=<folder> -P browser_test.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/browser.cmake)
if(missing)
  message(STATUS "skipped: ${missing}")
  return()
endif()

set(robot ${ROOT}/tests/robots/pendulum)
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
run(${PROGRAM} twin ${robot}/model.yaml --with quadratic@drive:drag=3e-6
  --experiment ${robot}/experiments/chirp.yaml ${robot}/experiments/steps.yaml ${robot}/experiments/multisine.yaml
  --out trials)
file(APPEND ${OUT}/trials/steps/trial.yaml "events: [0.5 s, 1.2 s]\n")
run(${PROGRAM} report trials/chirp trials/steps trials/multisine -o report.html)
run(${PROGRAM} report trials/chirp --no-diagnose -o compared.html)
run(${node} ${ROOT}/tests/report/browser_test.mjs ${playwright} ${chromium} ${OUT})
