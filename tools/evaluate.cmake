if(NOT TARGET prospect_planner)
  return()
endif()
add_library(prospect_crew_search STATIC ${CMAKE_CURRENT_SOURCE_DIR}/evaluate/crew_search.cpp)
prospect_target(prospect_crew_search)
target_link_libraries(prospect_crew_search PUBLIC prospect_planner)

if(NOT TARGET prospect_sim OR NOT TARGET prospect_agent OR NOT TARGET prospect_engine)
  return()
endif()
# The episode in one process: its world and its minds.
set(evaluate ${CMAKE_CURRENT_SOURCE_DIR}/evaluate)
add_library(prospect_local_episode STATIC ${evaluate}/decider.cpp ${evaluate}/engine_model.cpp ${evaluate}/episode.cpp
  ${evaluate}/local_mind.cpp ${evaluate}/search_deciders.cpp ${evaluate}/simulated_world.cpp ${evaluate}/simulator_model.cpp)
prospect_target(prospect_local_episode)
target_link_libraries(prospect_local_episode PUBLIC prospect_agent prospect_cli prospect_sim prospect_model prospect_crew_search)

if(NOT TARGET prospect_film)
  return()
endif()
add_library(prospect_evaluate_lib STATIC ${evaluate}/calibrate.cpp ${evaluate}/record_file.cpp ${evaluate}/shift_sweep.cpp
  ${evaluate}/plan_outcomes.cpp ${evaluate}/plan_rank.cpp ${evaluate}/plan_scores.cpp
  ${evaluate}/recovery.cpp ${evaluate}/report.cpp ${evaluate}/scene_draw.cpp ${evaluate}/scene_video.cpp)
prospect_target(prospect_evaluate_lib)
target_link_libraries(prospect_evaluate_lib PUBLIC prospect_local_episode prospect_score_words
  prospect_tools_common prospect_film)
