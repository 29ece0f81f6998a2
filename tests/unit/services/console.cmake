if(TARGET prospect_console_lib)
  prospect_test(services_console_test SOURCES console_model_test.cpp console_guard_test.cpp LIBS prospect_console_lib)
endif()
