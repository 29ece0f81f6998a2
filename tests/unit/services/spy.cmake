if(NOT TARGET prospect_types_jar)  # no Java, no spy
  return()
endif()
find_program(XVFB Xvfb REQUIRED)
add_test(NAME services_spy_starts COMMAND ${WITH_BUS} ${CMAKE_CURRENT_SOURCE_DIR}/spy_starts.sh
  $<TARGET_FILE:prospect> ${PROSPECT_JAR} ${PROSPECT_TYPE_COUNT})
set_tests_properties(services_spy_starts PROPERTIES LABELS unit TIMEOUT ${PROSPECT_TEST_SECONDS})
