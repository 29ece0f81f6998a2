# Every target of ours goes through prospect_target: includes are written from the repository root
# (#include "planner/path.h"), and warnings are errors. Third-party headers stay SYSTEM, thus silent.
option(PROSPECT_WERROR "Treat warnings as errors" ON)

function(prospect_target name)
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor)
  if(PROSPECT_WERROR)
    target_compile_options(${name} PRIVATE -Werror)
  endif()
endfunction()

# prospect_test(NAME LABEL SOURCES... LIBS...): one gtest program, one ctest entry, a deadline.
function(prospect_test name)
  cmake_parse_arguments(T "" "LABEL;TIMEOUT" "SOURCES;LIBS" ${ARGN})
  if(NOT T_LABEL)
    set(T_LABEL unit)
  endif()
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 120)
  endif()
  add_executable(${name} ${T_SOURCES})
  prospect_target(${name})
  target_link_libraries(${name} PRIVATE ${T_LIBS} GTest::gtest GTest::gtest_main Threads::Threads)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS ${T_LABEL} TIMEOUT ${T_TIMEOUT})
endfunction()
