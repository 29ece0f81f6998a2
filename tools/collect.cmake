if(NOT TARGET prospect_sim OR NOT TARGET prospect_dataset)
  return()
endif()
find_package(nlohmann_json 3 REQUIRED)
set(collect ${CMAKE_CURRENT_SOURCE_DIR}/collect)
add_library(prospect_collect_lib STATIC ${collect}/collector.cpp ${collect}/trial_recorder.cpp)
prospect_target(prospect_collect_lib)
target_link_libraries(prospect_collect_lib PUBLIC prospect_sim prospect_dataset prospect_tools_common
  PRIVATE nlohmann_json::nlohmann_json)
# Videos of gestures (--format jigsaws): where report/ is built.
if(TARGET prospect_video)
  add_library(prospect_gesture_videos STATIC ${collect}/gesture_trial.cpp ${collect}/gesture_videos.cpp)
  prospect_target(prospect_gesture_videos)
  target_link_libraries(prospect_gesture_videos PUBLIC prospect_collect_lib prospect_video
    PRIVATE nlohmann_json::nlohmann_json)
endif()
