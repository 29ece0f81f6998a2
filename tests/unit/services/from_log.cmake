if(TARGET prospect_log_import)
  prospect_test(services_from_log_test SOURCES from_log_test.cpp LIBS prospect_log_import)
endif()
# What goes over the bus must come back as what the collector makes: the real world, the real simulator's messages.
if(TARGET prospect_log_import AND TARGET prospect_collect_lib AND TARGET prospect_simulator_lib)
  prospect_test(services_from_log_equals_collect_test SOURCES from_log_equals_collect_test.cpp
    LIBS prospect_log_import prospect_collect_lib prospect_simulator_lib)
endif()
if(TARGET prospect_log_import AND TARGET prospect_recordings AND TARGET prospect_simulator_lib)
  prospect_test(services_from_log_equals_video_test SOURCES from_log_equals_video_test.cpp
    LIBS prospect_log_import prospect_recordings prospect_video prospect_simulator_lib)
  target_compile_definitions(services_from_log_equals_video_test PRIVATE PROSPECT_ROOT="${CMAKE_SOURCE_DIR}")
endif()
