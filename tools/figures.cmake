# Pictures with words and curves: only where OpenCV is.
if(NOT OpenCV_FOUND OR NOT TARGET prospect_training OR NOT TARGET prospect_evaluate_lib)
  return()
endif()
find_package(CLI11 REQUIRED)
set(figures ${CMAKE_CURRENT_SOURCE_DIR}/figures)
add_library(prospect_figures_lib STATIC ${figures}/calibration.cpp ${figures}/color.cpp ${figures}/futures.cpp
  ${figures}/heat_panel.cpp ${figures}/held_out.cpp ${figures}/hidden_states.cpp ${figures}/imagined.cpp
  ${figures}/judgements.cpp ${figures}/loaded_model.cpp ${figures}/page.cpp ${figures}/predictions.cpp ${figures}/random_states.cpp
  ${figures}/search.cpp ${figures}/search_story.cpp ${figures}/sheet.cpp ${figures}/strip.cpp ${figures}/task_table.cpp
  ${figures}/variants.cpp)
prospect_target(prospect_figures_lib)
target_include_directories(prospect_figures_lib SYSTEM PRIVATE ${OpenCV_INCLUDE_DIRS})
target_link_libraries(prospect_figures_lib PUBLIC prospect_evaluate_lib prospect_training prospect_tools_common
  PRIVATE opencv_core opencv_imgproc)
add_executable(prospect-figures ${figures}/main.cpp)
prospect_target(prospect-figures)
target_link_libraries(prospect-figures PRIVATE prospect_figures_lib prospect_torch_main CLI11::CLI11)
