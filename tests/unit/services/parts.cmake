# The parts of the services that need no bus.
if(TARGET prospect_binding)
  prospect_test(services_binding_test SOURCES parts/messages_test.cpp parts/request_window_test.cpp parts/shared_search_test.cpp
    LIBS prospect_binding)
endif()
if(TARGET prospect_simulator_lib)
  prospect_test(services_simulator_test SOURCES parts/command_gate_test.cpp parts/scene_test.cpp LIBS prospect_simulator_lib)
endif()
if(TARGET prospect_model_server_lib)
  prospect_test(services_model_test SOURCES parts/batch_timing_test.cpp parts/request_queue_test.cpp parts/scripted_tree_engine_test.cpp
    parts/search_memory_test.cpp
    LIBS prospect_model_server_lib prospect_engine_scripted)
endif()
if(TARGET prospect_executive_lib)
  find_package(nlohmann_json 3 REQUIRED)
  prospect_test(services_executive_test SOURCES parts/policy_test.cpp parts/trial_counts_test.cpp
    LIBS prospect_executive_lib nlohmann_json::nlohmann_json)
endif()
if(TARGET prospect_replay_lib)
  prospect_test(services_replay_test SOURCES parts/journal_test.cpp LIBS prospect_replay_lib)
endif()
if(TARGET prospect_model_server_lib)
  prospect_bus_test(services_calibration_server_test SOURCES calibration_server_test.cpp
    LIBS prospect_model_server_lib prospect_engine_scripted)
endif()
if(TARGET prospect_player_lib)
  prospect_test(services_player_test SOURCES parts/video_scene_test.cpp LIBS prospect_player_lib prospect_video)
endif()
