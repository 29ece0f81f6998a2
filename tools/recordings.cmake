# Videos, and demonstrations of others, to data sets.
if(NOT TARGET prospect_video OR NOT TARGET prospect_dataset OR NOT TARGET prospect_drawing OR NOT TARGET prospect_tasks)
  return()
endif()
set(recordings ${CMAKE_CURRENT_SOURCE_DIR}/recordings)
add_library(prospect_recordings STATIC
  ${recordings}/conversion.cpp ${recordings}/from_robomimic.cpp ${recordings}/from_video.cpp ${recordings}/video_folder.cpp)
prospect_target(prospect_recordings)
target_link_libraries(prospect_recordings PUBLIC prospect_dataset prospect_tasks prospect_tools_common
  PRIVATE prospect_video prospect_drawing)
