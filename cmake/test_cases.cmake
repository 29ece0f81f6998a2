# prospect_cases(PROGRAM PREFIX LABELS... TIMEOUT SECONDS [LAUNCHER...]): a ctest entry PREFIX.SUITE.CASE for each case of a
# gtest program, run by the launcher. No list of cases exists: ctest asks the program each time (list_cases.cmake), so that
# none is forgotten. Asking takes milliseconds and no launcher, thus no bus.
function(prospect_cases program)
  cmake_parse_arguments(C "" "PREFIX;TIMEOUT" "LABELS;LAUNCHER" ${ARGN})
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${program}_cases.cmake)
  file(GENERATE OUTPUT ${script} CONTENT
"set(program [==[$<TARGET_FILE:${program}>]==])
set(name ${program})
set(prefix ${C_PREFIX})
set(launcher [==[${C_LAUNCHER}]==])
set(labels [==[${C_LABELS}]==])
set(timeout ${C_TIMEOUT})
include([==[${CMAKE_SOURCE_DIR}/cmake/list_cases.cmake]==])
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()
