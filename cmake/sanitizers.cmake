# PROSPECT_SANITIZE: empty, asan (address and undefined behaviour) or tsan (threads).
set(PROSPECT_SANITIZE "" CACHE STRING "asan, tsan or empty")
# How long a test may take, in seconds; instrumented programs are that much slower.
set(PROSPECT_TEST_SECONDS 120)
if(PROSPECT_SANITIZE STREQUAL "asan")
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  set(PROSPECT_TEST_SECONDS 480)
elseif(PROSPECT_SANITIZE STREQUAL "tsan")
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer -g1)  # lines are enough for reports, and build twice as fast
  add_link_options(-fsanitize=thread)
  set(PROSPECT_TEST_SECONDS 1200)
elseif(PROSPECT_SANITIZE)
  message(FATAL_ERROR "PROSPECT_SANITIZE is '${PROSPECT_SANITIZE}': say asan, tsan or nothing")
endif()
math(EXPR PROSPECT_LONG_TEST_SECONDS "2 * ${PROSPECT_TEST_SECONDS}")

# GCC 12 warns of its own std::regex once sanitizers keep it from seeing through it.
function(prospect_quiet_regex)
  if(PROSPECT_SANITIZE)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -Wno-maybe-uninitialized)
  endif()
endfunction()

# libFuzzer targets (tests/fuzz): everything is instrumented, so this wants clang and a build folder of its own.
option(PROSPECT_FUZZ "Build libFuzzer targets instead of the tests of tests/fuzz; needs clang" OFF)
if(PROSPECT_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "PROSPECT_FUZZ needs clang: -DCMAKE_CXX_COMPILER=clang++ (packages clang, libclang-rt-14-dev)")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=address,undefined)
endif()
