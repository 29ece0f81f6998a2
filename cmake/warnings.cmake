# Every target of ours goes through prospect_target: includes are written from the repository root
# (#include "planner/path.h"), and warnings are errors. Third-party headers stay SYSTEM, thus silent.
option(PROSPECT_WERROR "Treat warnings as errors" ON)

function(prospect_target name)
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor)
  # GCC 12 warns falsely of C++20's constexpr std::string (overlapping copies, GCC bug 105329) and of vectors of bytes that are
  # compared three-way (a bound beyond any object).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${name} PRIVATE -Wno-restrict -Wno-stringop-overread)
  endif()
  if(PROSPECT_WERROR)
    target_compile_options(${name} PRIVATE -Werror)
  endif()
endfunction()

# Tests that need no libtorch, whose headers take most of a build, are quick: ./prospect test --quick builds and runs
# these alone (target quick_tests, label quick).
set(PROSPECT_SLOW_TO_BUILD "prospect_(torch_engine|training)")
function(prospect_quick_label label)
  if(NOT "${ARGN}" MATCHES "${PROSPECT_SLOW_TO_BUILD}(;|$)" AND NOT "${${label}}" MATCHES "slow")
    set(${label} ${${label}} quick PARENT_SCOPE)
  endif()
endfunction()
function(prospect_note_quick name label)
  if(NOT TARGET quick_tests)
    add_custom_target(quick_tests)
  endif()
  if("${label}" MATCHES "quick")
    add_dependencies(quick_tests ${name})
  endif()
endfunction()

# prospect_test(NAME LABEL SOURCES... LIBS... [LAUNCHER...]): one gtest program, one ctest entry, a deadline; run by the
# launcher, if one is given.
function(prospect_test name)
  cmake_parse_arguments(T "" "LABEL;TIMEOUT" "SOURCES;LIBS;LAUNCHER" ${ARGN})
  if(NOT T_LABEL)
    set(T_LABEL unit)
  endif()
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT ${PROSPECT_TEST_SECONDS})
  endif()
  add_executable(${name} ${T_SOURCES})
  prospect_target(${name})
  target_link_libraries(${name} PRIVATE ${T_LIBS} GTest::gtest GTest::gtest_main Threads::Threads)
  prospect_quick_label(T_LABEL ${T_LIBS})
  prospect_note_quick(${name} "${T_LABEL}")
  add_test(NAME ${name} COMMAND ${T_LAUNCHER} $<TARGET_FILE:${name}>)
  set_tests_properties(${name} PROPERTIES LABELS "${T_LABEL}" TIMEOUT ${T_TIMEOUT})
endfunction()
