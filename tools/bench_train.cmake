if(NOT TARGET prospect_training OR NOT TARGET prospect_sim OR NOT TARGET prospect_agent)
  return()
endif()
add_library(prospect_train_bench_lib STATIC
  ${CMAKE_CURRENT_SOURCE_DIR}/bench/engine_agreement.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/bench/engine_bench.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/bench/matrix_peak.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/bench/multiply_adds.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/bench/random_trials.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/bench/train_bench.cpp)
prospect_target(prospect_train_bench_lib)
target_link_libraries(prospect_train_bench_lib PUBLIC prospect_training prospect_local_episode PRIVATE prospect_task_training)
prospect_precompiled(prospect_train_bench_lib prospect_training)
