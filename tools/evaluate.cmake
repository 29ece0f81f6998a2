if(NOT TARGET prospect_planner)
  return()
endif()
add_library(prospect_crew_search STATIC ${CMAKE_CURRENT_SOURCE_DIR}/evaluate/crew_search.cpp)
prospect_target(prospect_crew_search)
target_link_libraries(prospect_crew_search PUBLIC prospect_planner)

if(NOT TARGET prospect_sim OR NOT TARGET prospect_training OR NOT TARGET prospect_film)
  return()
endif()
set(evaluate ${CMAKE_CURRENT_SOURCE_DIR}/evaluate)
add_library(prospect_evaluate_lib STATIC ${evaluate}/calibrate.cpp ${evaluate}/decider.cpp ${evaluate}/engine_model.cpp ${evaluate}/episode.cpp
  ${evaluate}/novelty_gate.cpp ${evaluate}/open_loop.cpp ${evaluate}/record_file.cpp ${evaluate}/shift_sweep.cpp
  ${evaluate}/plan_outcomes.cpp ${evaluate}/plan_scores.cpp
  ${evaluate}/recovery.cpp ${evaluate}/report.cpp ${evaluate}/scene_draw.cpp ${evaluate}/scene_video.cpp ${evaluate}/search_deciders.cpp ${evaluate}/simulator_model.cpp)
prospect_target(prospect_evaluate_lib)
target_link_libraries(prospect_evaluate_lib PUBLIC prospect_sim prospect_model prospect_training prospect_planner prospect_crew_search
  prospect_tools_common prospect_torch_main prospect_film)
add_executable(prospect-evaluate ${evaluate}/main.cpp)
prospect_target(prospect-evaluate)
target_link_libraries(prospect-evaluate PRIVATE prospect_evaluate_lib prospect_engine)
add_executable(prospect-evaluate-plans ${evaluate}/plans_main.cpp)
prospect_target(prospect-evaluate-plans)
target_link_libraries(prospect-evaluate-plans PRIVATE prospect_evaluate_lib prospect_engine)
