# Pictures with words and curves.
if(NOT TARGET prospect_drawing OR NOT TARGET prospect_evaluate_lib)
  return()
endif()
set(figures ${CMAKE_CURRENT_SOURCE_DIR}/figures)
add_library(prospect_figures_lib STATIC ${figures}/calibration.cpp ${figures}/cells.cpp ${figures}/drawings.cpp ${figures}/futures.cpp
  ${figures}/held_out.cpp ${figures}/hidden_states.cpp ${figures}/imagined.cpp
  ${figures}/judgements.cpp ${figures}/loaded_model.cpp ${figures}/predictions.cpp ${figures}/random_states.cpp
  ${figures}/search.cpp ${figures}/search_story.cpp ${figures}/studio.cpp ${figures}/task_table.cpp
  ${figures}/variants.cpp)
prospect_target(prospect_figures_lib)
target_link_libraries(prospect_figures_lib PUBLIC prospect_evaluate_lib prospect_samples prospect_score_words prospect_train_config
  prospect_drawing prospect_tools_common
  PRIVATE prospect_cli)
