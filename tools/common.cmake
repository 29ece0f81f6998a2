add_library(prospect_tools_common STATIC
  ${CMAKE_CURRENT_SOURCE_DIR}/common/causes.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/common/fork_map.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/common/interval.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/common/progress.cpp)
prospect_target(prospect_tools_common)
target_link_libraries(prospect_tools_common PUBLIC prospect_base)
if(TARGET prospect_training)
  add_library(prospect_tools_guarded STATIC ${CMAKE_CURRENT_SOURCE_DIR}/common/guarded.cpp)
  prospect_target(prospect_tools_guarded)
  target_link_libraries(prospect_tools_guarded PUBLIC prospect_training)
endif()
